#include "questions/q1_uniform/study.h"

#include <gtest/gtest.h>

namespace meshfolio::q1_uniform {

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

}   // namespace meshfolio::q1_uniform
