#include "questions/q1_uniform/study.h"

#include <gtest/gtest.h>

#include "mesh/samples/sample_shapes.h"
#include "questions/bench/bench_mesh.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q1_uniform {
using namespace testing_tools;

// The worst of each kind may lie on different surfaces: their ratio is that of no surface.
TEST(Q1, JitterIsJudgedSurfaceBySurface) {
    BenchRuns runs;
    const auto add = [&](MeshKind kind, const char* surface, double H, double K) {
        BenchLevel level;
        level.errors[uniform_H].l2 = H;
        level.errors[deficit_K].l2 = K;
        runs.push_back({surface, "", kind, {BenchLevel{}, level}});
    };
    add(MeshKind::regular, "sphere", 0.2, 0.01);
    add(MeshKind::regular, "torus", 0.01, 0.5);
    add(MeshKind::jittered, "sphere", 0.6, 0.01);
    add(MeshKind::jittered, "torus", 0.5, 0.25);
    EXPECT_DOUBLE_EQ(jitter_factors(runs, uniform_H).least, 3);
    EXPECT_DOUBLE_EQ(jitter_factors(runs, uniform_H).most, 50);
    EXPECT_TRUE(jitter_factors(runs, uniform_H).matter());
    EXPECT_DOUBLE_EQ(jitter_factors(runs, deficit_K).least, 0.5);
    EXPECT_DOUBLE_EQ(jitter_factors(runs, deficit_K).most, 1);
    EXPECT_FALSE(jitter_factors(runs, deficit_K).matter());
}

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

}   // namespace meshfolio::q1_uniform
