#include "questions/q7_denoising/study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q7_denoising {
using namespace testing_tools;

namespace {

DenoisingGrid quick_grid_on(const TriangleMesh& mesh, const std::string& name) {
    return denoising_grid(library_mesh(mesh, name), quick_settings());
}

ModeBands bands_of(const DenoisingGrid& grid, const NoisyTrial& trial) { return mode_bands(grid, trial, error_parts(grid, trial.noisy)); }

}   // namespace

TEST(DenoisingReasons, NoiseIsEquallyStrongInAllModesAndShapeIsNot) {
    const DenoisingGrid grid = quick_grid_on(icosphere(3), "ball_modes");   // 642 vertices
    const ModeBands bands = bands_of(grid, grid.trials.back());
    EXPECT_TRUE(bands.all);
    EXPECT_EQ(bands.modes, 641);
    for (const double noise : bands.noise) EXPECT_NEAR(noise, 1, 0.35) << "rms over 24 numbers at least";
    EXPECT_GT(bands.shape.front(), 10);
    EXPECT_LT(bands.shape.back(), 0.1);
    ASSERT_TRUE(bands.crosses());
    const auto after = std::ranges::upper_bound(bands.mu, bands.crossing) - bands.mu.begin();   // the bands beside the crossing
    EXPECT_GE(bands.shape[after - 1], 1);
    EXPECT_LT(bands.shape[after], 1);
    EXPECT_GT(bands.wavelength(), 2) << "of mean edges: no wave is shorter";
    for (std::size_t i = 1; i < bands.mu.size(); ++i) {
        EXPECT_GT(bands.mu[i], bands.mu[i - 1]);
        EXPECT_LT(bands.kept[i], bands.kept[i - 1]);
    }
}

// Σ |Φᵀ M N|² over all modes but the constants is Σ M_i |N_i|² about the mean.
TEST(DenoisingReasons, TheUnitIsTheNoiseOfOneMode) {
    const DenoisingGrid grid = quick_grid_on(cube_mesh(8), "cube_modes");
    NoisyTrial doubled = grid.trials.front();
    doubled.sigma *= 2;   // the same noise, told as twice as much
    const ModeBands one = bands_of(grid, grid.trials.front()), half = bands_of(grid, doubled);
    for (std::size_t i = 0; i < one.noise.size(); ++i) EXPECT_NEAR(half.noise[i], one.noise[i] / 2, 1e-12);
}

TEST(DenoisingReasons, TheErrorIsTheNoiseLeftAndTheShapeLost) {
    const DenoisingGrid grid = quick_grid_on(icosphere(3), "ball_parts");
    const ErrorParts parts = error_parts(grid, grid.trials.back().noisy);
    ASSERT_EQ(parts.total.amount, parts.noise.amount);
    EXPECT_EQ(parts.shape.error.front(), 0);
    EXPECT_EQ(parts.noise.error.front(), parts.total.error.front());
    EXPECT_LT(parts.deviation_of_sum(), 0.1);
    for (std::size_t i = 1; i < parts.total.amount.size(); ++i) {
        EXPECT_GT(parts.total.amount[i], parts.total.amount[i - 1]);
        EXPECT_LE(parts.total.error[i], parts.noise.error[i] + parts.shape.error[i] + 1e-12) << "the triangle inequality";
    }
    EXPECT_GT(parts.shape.error.back(), parts.noise.error.back()) << "in the end";
    EXPECT_NEAR(parts.best_lambda * parts.best_step, parts.total.amount[parts.total.least()], 1e-12) << "what the plot of the modes shows";
}

// Each λ but the smallest counts from its third step on, beyond the amounts of smaller λ.
TEST(DenoisingReasons, ACurveHasEachAmountOnce) {
    const DenoisingGrid grid = quick_grid_on(cube_mesh(8), "cube_curve");
    for (const NoisyTrial& trial : grid.trials) {
        const ErrorCurve curve = error_curve(grid, trial);
        EXPECT_NEAR(curve.error.front(), trial.found.noisy.shape / grid.mean_edge, 1e-15);
        for (std::size_t i = 1; i < curve.amount.size(); ++i) {
            EXPECT_GT(curve.amount[i], curve.amount[i - 1]);
            const auto state = std::ranges::find_if(trial.states, [&](const SearchState& s) {
                return s.value * s.step == curve.amount[i] && s.shape / grid.mean_edge == curve.error[i];
            });
            ASSERT_NE(state, trial.states.end());
            EXPECT_TRUE(state->value == grid.lambdas.front() || state->step >= 3);
        }
    }
}

TEST(DenoisingReasons, WithoutNoiseOnlyShapeIsLost) {
    const DenoisingGrid grid = quick_grid_on(cube_mesh(6), "cube_clean");
    const ErrorParts parts = error_parts(grid, grid.clean->mesh());
    EXPECT_EQ(*std::ranges::max_element(parts.noise.error), 0);
    EXPECT_EQ(parts.total.error, parts.shape.error);
    for (std::size_t i = 1; i < parts.shape.error.size(); ++i) EXPECT_GT(parts.shape.error[i], parts.shape.error[i - 1]);
}

TEST(DenoisingReasons, TheSmallestMeshThatGainsIsShown) {
    const std::vector<DenoisingGrid> grids{quick_grid_on(icosphere(3), "larger"), quick_grid_on(icosphere(2), "smaller")};
    EXPECT_EQ(reasons_of(grids).grid, &grids[1]);
    std::vector<DenoisingGrid> none = grids;
    for (DenoisingGrid& grid : none)
        for (NoisyTrial& trial : grid.trials) trial.found.by_shape = trial.found.noisy;
    EXPECT_EQ(reasons_of(none).grid, nullptr);
}

}   // namespace meshfolio::q7_denoising
