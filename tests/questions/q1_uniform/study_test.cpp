#include "questions/q1_uniform/parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/curvature/curvature.h"
#include "geometry/operators/vertex_areas.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/bench/bench_mesh.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q1_uniform {
using namespace testing_tools;

TEST(UniformStudy, TheNormalPartOfAJitteredSphereIsNearerToItsCurvature) {
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

TEST(UniformStudy, AContrastComparesQuarters) {
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

TEST(UniformStudy, TheTwelveIrregularVerticesOfAnIcosphereStandOutByTheirAreas) {
    const IrregularVertices odd = irregular_vertices(curvature_of(library_mesh(icosphere(3), "icosphere1")));
    EXPECT_EQ(odd.vertices.size(), 12u);
    EXPECT_TRUE(odd.stand_out());
    EXPECT_TRUE(odd.area_is_why());
    const IrregularVertices none = irregular_vertices(curvature_of(library_mesh(torus_mesh(24, 12, 1, 0.4), "torus1")));
    EXPECT_TRUE(none.vertices.empty());   // K has both signs
}

// K with Voronoi areas is compared with its own median, not with that of barycentric areas.
TEST(UniformStudy, KWithVoronoiAreasIsComparedWithItsOwnMedian) {
    const TriangleMesh ball = icosphere(3);
    const MeshTopology topology = topology_of(ball);
    const Vector K = gaussian_curvature(ball, topology, vertex_areas(ball, AreaForm::voronoi));
    const double median = summary_of(K).median;
    const MeshCurvature c = curvature_of(library_mesh(ball, "icosphere2"));
    const IrregularVertices odd = irregular_vertices(c);
    double most = 0;
    for (const int v : odd.vertices) most = std::max(most, std::abs(K[v] / median - 1));
    EXPECT_NEAR(odd.off_with_voronoi, most, 1e-12);
    EXPECT_GT(std::abs(summary_of(c.K).median / median - 1), 0.1 * most);   // or else it would make no difference
}

TEST(UniformStudy, SmallKCountsByItsSignAndRoundingDoesNot) {
    const MeshCurvature torus = curvature_of(library_mesh(torus_mesh(48, 24, 1, 0.4), "signs1"));
    const auto share = [&](auto chosen) { return double(chosen.count()) / double(torus.K.size()); };
    EXPECT_EQ(signs_of_K(torus).all.negative, share(torus.K.array() < -1e-9));   // where it is 0 it is rounding
    EXPECT_EQ(signs_of_K(torus).all.positive, share(torus.K.array() > 1e-9));
    TriangleMesh sheet = grid_mesh(9, 9, 1, 1);
    sheet.X = sheet.X * Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    const SignsOfK flat = signs_of_K(curvature_of(library_mesh(sheet, "signs_sheet1")));
    EXPECT_EQ(flat.all.negative, 0);
    EXPECT_EQ(flat.all.positive, 0);
}

TEST(UniformStudy, UniformHVariesOnASphereWithConstantH) {
    TriangleMesh ball = icosphere(3);
    ball.X = jittered(ball, topology_of(ball), 0.2, 1, [](const Vector3& p) { return p.normalized(); });
    const Picture picture = picture_of(curvature_of(library_mesh(ball, "picture1")));
    EXPECT_TRUE(picture.is_even());
    EXPECT_TRUE(picture.varies_where_truth_does_not());
    EXPECT_LT(picture.cotangent_spread, 1.5);
    EXPECT_GT(picture.spread, 2);
    ball.X *= 50;   // a picture does not know the unit of length
    EXPECT_NEAR(picture_of(curvature_of(library_mesh(ball, "large_picture1"))).correlation, picture.correlation, 1e-9);
    // With equal rings both show the same form.
    const Picture torus = picture_of(curvature_of(library_mesh(torus_mesh(48, 24, 1, 0.4), "picture_torus1")));
    EXPECT_FALSE(torus.varies_where_truth_does_not());
    EXPECT_GT(torus.correlation, 0.9);
}

}   // namespace meshfolio::q1_uniform
