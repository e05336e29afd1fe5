#include "questions/q1_uniform/parts.h"

#include <gtest/gtest.h>

#include "mesh/samples/sample_shapes.h"
#include "questions/bench/bench_mesh.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q1_uniform {
using namespace testing_tools;

TEST(UniformStudy, TheNormalPartOfAJitteredSphereIsItsCurvature) {
    TriangleMesh ball = icosphere(3);
    ball.X = jittered(ball, topology_of(ball), 0.2, 1, [](const Vector3& p) { return p.normalized(); });
    const TangentialPart part = tangential_part(curvature_of(library_mesh(ball, "jittered_ball")));
    EXPECT_GT(part.share, 0.3);
    EXPECT_LT(part.share, 1);
    EXPECT_LT(part.normal_gap, 0.3 * part.gap);
    ball.X *= 7;   // shares do not know the unit of length
    const TangentialPart large = tangential_part(curvature_of(library_mesh(ball, "large_ball")));
    EXPECT_NEAR(large.share, part.share, 1e-12);
    EXPECT_NEAR(large.gap, part.gap, 1e-9);
}

TEST(UniformStudy, AContrastIsOfQuarters) {
    Vector values(12), by(12);
    for (int i = 0; i < 12; ++i) {
        values[i] = i;
        by[i] = -i;
    }
    EXPECT_EQ(contrast(values, by).least, 10);   // of 11, 10 and 9
    EXPECT_EQ(contrast(values, by).most, 1);
    values.tail(6).setConstant(std::nan(""));
    EXPECT_TRUE(std::isnan(contrast(values, by).least));   // too few are left
}

TEST(UniformStudy, OnAnIcosphereTheTwelveIrregularVerticesStandOutByTheirAreas) {
    const IrregularVertices odd = irregular_vertices(curvature_of(library_mesh(icosphere(3), "icosphere1")));
    EXPECT_EQ(odd.vertices.size(), 12u);
    EXPECT_TRUE(odd.stand_out());
    EXPECT_TRUE(odd.area_is_why());
    const IrregularVertices none = irregular_vertices(curvature_of(library_mesh(torus_mesh(24, 12, 1, 0.4), "torus1")));
    EXPECT_TRUE(none.vertices.empty());   // K has both signs
}

TEST(UniformStudy, APictureMisleadsWhereTheTruthIsConstantOrUnlikeIt) {
    TriangleMesh ball = icosphere(3);
    ball.X = jittered(ball, topology_of(ball), 0.2, 1, [](const Vector3& p) { return p.normalized(); });
    const Picture picture = picture_of(curvature_of(library_mesh(ball, "picture1")));
    EXPECT_TRUE(picture.misleads());
    EXPECT_LT(picture.cotangent_spread, 1.5);
    EXPECT_GT(picture.spread, 2);
    ball.X *= 50;   // a picture does not know the unit of length
    EXPECT_NEAR(picture_of(curvature_of(library_mesh(ball, "large_picture1"))).correlation, picture.correlation, 1e-9);
    // Where all rings are alike both see the same form.
    const Picture torus = picture_of(curvature_of(library_mesh(torus_mesh(48, 24, 1, 0.4), "picture_torus1")));
    EXPECT_FALSE(torus.misleads());
    EXPECT_GT(torus.correlation, 0.9);
}

}   // namespace meshfolio::q1_uniform
