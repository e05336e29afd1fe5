#include "questions/q7_denoising/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q7_denoising {
using namespace testing_tools;

namespace {

DenoisingGrid grid_on(const TriangleMesh& mesh, const std::string& name, QuestionSettings settings = quick_settings()) {
    return denoising_grid(library_mesh(mesh, name), settings);
}

}   // namespace

TEST(DenoisingGrid, EveryMeasureHasItsOwnBestOfAllStates) {
    for (const TriangleMesh& mesh : {cube_mesh(8), icosphere(3)}) {
        for (const NoisyTrial& trial : grid_on(mesh, "best7").trials) {
            for (const Measure& measure : measures) {
                double least = trial.found.noisy.*measure.error;
                for (const SearchState& state : trial.states) least = std::min(least, state.*measure.error);
                EXPECT_EQ(trial.best_by(measure).*measure.error, least) << measure.key;
            }
        }
    }
}

TEST(DenoisingGrid, AStateIsTheResultOfSmoothing) {
    const DenoisingGrid grid = grid_on(cube_mesh(8), "cube_state");
    const NoisyTrial& trial = grid.trials.back();
    const SearchState& best = trial.found.by_shape;
    ASSERT_GT(best.step, 0);
    SmoothingOptions options;
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = best.value * grid.mean_edge * grid.mean_edge;
    options.iterations = best.step;
    const Positions X = smooth(trial.noisy, options).X;
    EXPECT_LE((X - trial.best.X).norm(), 1e-9 * X.norm());
    EXPECT_NEAR(best.rms, vertex_rms(grid.clean->mesh().X, X), 1e-9 * best.rms);
    options.iterations = 4 * best.step;
    EXPECT_LE((smooth(trial.noisy, options).X - trial.over.X).norm(), 1e-9 * X.norm());
}

TEST(DenoisingGrid, ARunEndsAfterEveryMeasureGotWorse) {
    const DenoisingGrid grid = grid_on(icosphere(3), "ball_ends");
    for (const NoisyTrial& trial : grid.trials) {
        std::set<double> lambdas;
        for (const SearchState& state : trial.states) lambdas.insert(state.value);
        EXPECT_EQ(std::vector(lambdas.begin(), lambdas.end()), grid.lambdas);
        for (const double lambda : grid.lambdas) {
            const auto of_run = [&](const SearchState& s) { return s.value == lambda; };
            const auto steps = std::ranges::count_if(trial.states, of_run);
            if (steps == grid.iterations) continue;
            EXPECT_GE(steps, 12);
            for (const Measure& measure : measures) {
                const SearchState* best = nullptr;
                for (const SearchState& s : trial.states)
                    if (of_run(s) && (best == nullptr || s.*measure.error < best->*measure.error)) best = &s;
                EXPECT_LE(2 * best->step, steps) << measure.key << " at " << lambda;
            }
        }
    }
}

TEST(DenoisingGrid, TheNoiseHasTheLevelOfTheSettings) {
    QuestionSettings settings = quick_settings();
    settings.noise = {0.01, 0.002, 0.01};
    const DenoisingGrid grid = grid_on(cube_mesh(8), "cube_noise", settings);
    ASSERT_EQ(grid.trials.size(), 2u) << "a level named twice is one";
    for (const NoisyTrial& trial : grid.trials) {
        const double rms = trial.found.noisy.rms;
        EXPECT_EQ(rms, vertex_rms(grid.clean->mesh().X, trial.noisy.X));
        EXPECT_NEAR(rms, std::sqrt(3.0) * trial.sigma, 5 / std::sqrt(6.0 * grid.clean->mesh().vertex_count()) * rms);
        EXPECT_LE(trial.found.noisy.shape, rms);
    }
}

TEST(DenoisingGrid, FurtherSamplesAreSmoothedLikeTheFirst) {
    QuestionSettings settings;
    settings.noise = {0.01};
    settings.seed = 5;
    const NoisyTrial trial = grid_on(cube_mesh(6), "cube_samples", settings).trials[0];
    ASSERT_EQ(trial.further_gains.size(), 2u);
    settings.seed = 6;   // the first of the further ones
    settings.lambda = {trial.found.by_shape.value * std::pow(mean_edge_length(cube_mesh(6)), 2)};
    const NoisyTrial next = grid_on(cube_mesh(6), "cube_samples", settings).trials[0];
    const auto alike = std::ranges::find(next.states, trial.found.by_shape.step, &SearchState::step);
    ASSERT_NE(alike, next.states.end());
    EXPECT_NEAR(trial.further_gains[0], next.found.noisy.shape / alike->shape, 1e-9);
    EXPECT_TRUE(grid_on(cube_mesh(6), "cube_one").trials[0].further_gains.empty());
}

TEST(DenoisingGrid, FeaturesOfACubeAreItsEdges) {
    const DenoisingGrid cube = grid_on(cube_mesh(8), "cube_edges");
    EXPECT_EQ(cube.feature_vertices, 12 * 7 + 8);
    EXPECT_EQ(grid_on(icosphere(3), "ball_edges").feature_vertices, 0);
    EXPECT_TRUE(std::isnan(grid_on(icosphere(2), "ball_none").trials[0].residual.features.there));
}

TEST(DenoisingGrid, SmoothingTheCleanCubeLosesEdgesAndVolume) {
    const DenoisingGrid grid = grid_on(cube_mesh(10), "cube_taken");
    const NoisyTrial& trial = grid.pictured();
    SmoothingOptions options;
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = trial.found.by_shape.value * grid.mean_edge * grid.mean_edge;
    options.iterations = trial.found.by_shape.step;
    const TriangleMesh& clean = grid.clean->mesh();
    EXPECT_LE((smooth(clean, options).X - trial.clean_alike.X).norm(), 1e-9 * clean.X.norm());
    EXPECT_GT(trial.clean_loss.features.times(), 1.5);
    EXPECT_GT(trial.clean_loss.feature_angle, trial.clean_loss.other_angle);
    EXPECT_NEAR(trial.clean_loss.volume, signed_volume(trial.clean_alike) / signed_volume(clean), 1e-12);
    EXPECT_LT(trial.clean_loss.volume, 1);
}

TEST(DenoisingGrid, DriftAndSurfaceDistanceAddUpToTheVertexError) {
    const DenoisingGrid grid = grid_on(cube_mesh(8), "cube_drift");
    for (const NoisyTrial& trial : grid.trials) {
        const double error = vertex_rms(grid.clean->mesh().X, trial.best.X);
        const auto along = [&](const TriangleMesh& mesh) {
            return (mesh.X - grid.clean->mesh().X).squaredNorm() - shape_distances(grid.clean->mesh(), mesh.X).squaredNorm();
        };
        const auto across = [&](const TriangleMesh& mesh) { return (mesh.X - grid.clean->mesh().X).squaredNorm() - along(mesh); };
        const double n = grid.clean->mesh().vertex_count();
        EXPECT_NEAR(n * std::pow(NoisyTrial::drift(trial.found.by_shape), 2), along(trial.best), 1e-9 * n * error * error);
        EXPECT_NEAR(trial.removed_along(), 1 - along(trial.best) / along(trial.noisy), 1e-9);
        EXPECT_NEAR(trial.removed_across(), 1 - across(trial.best) / across(trial.noisy), 1e-9);
    }
}

TEST(DenoisingGrid, ThePicturedNoiseIsTheLowestWithHalvedError) {
    DenoisingGrid grid = grid_on(icosphere(2), "ball_pictured");
    ASSERT_EQ(grid.trials.size(), 2u);
    const auto gains = [&](double low, double high) {
        for (std::size_t i = 0; i < 2; ++i) {
            SearchResult& found = grid.trials[i].found;
            found.by_shape.step = 3;
            found.by_shape.shape = found.noisy.shape / (i == 0 ? low : high);
        }
        return &grid.pictured() - grid.trials.data();
    };
    EXPECT_EQ(gains(2.5, 4), 0);
    EXPECT_EQ(gains(1.5, 4), 1);
    EXPECT_EQ(gains(1.5, 1.2), 0);
}

TEST(DenoisingGrid, TheNoiseSplitSeparatesTheHalvedErrors) {
    DenoisingGrid grid;
    grid.mean_edge = 2;
    const auto split = [&](std::vector<std::pair<double, double>> levels) {   // σ, gain
        grid.trials.clear();
        for (const auto& [sigma, gain] : levels) {
            NoisyTrial& trial = grid.trials.emplace_back();
            trial.sigma = sigma;
            trial.found.noisy.shape = trial.found.noisy.rms = gain, trial.found.by_shape.shape = 1;
        }
        return noise_split({grid});
    };
    const NoiseSplit clear = split({{0.2, 1.5}, {0.6, 2}});
    EXPECT_TRUE(clear.decides);
    EXPECT_NEAR(clear.never_to, 0.1, 1e-15);
    EXPECT_NEAR(clear.always_from, 0.3, 1e-15);
    const NoiseSplit mixed = split({{0.2, 1.5}, {0.4, 3}, {0.6, 1.9}, {0.8, 2.5}});
    EXPECT_FALSE(mixed.decides);
    EXPECT_NEAR(mixed.never_to, 0.1, 1e-15);
    EXPECT_NEAR(mixed.always_from, 0.4, 1e-15);
    EXPECT_FALSE(split({{0.6, 1.9}, {0.6 * (1 + 1e-15), 2}}).decides) << "one level but for rounding";
    EXPECT_TRUE(std::isinf(split({{0.6, 3}, {0.8, 1}}).always_from)) << "the strongest fails";
    EXPECT_TRUE(std::isinf(split({{0.6, 0}}).always_from)) << "noise within a plane does not move the surface";
}

TEST(DenoisingGrid, OneNoiseLevelIsGivenInMeanEdges) {
    for (const TriangleMesh& mesh : {cube_mesh(4), icosphere(2)}) {
        const DenoisingGrid grid = grid_on(mesh, "level", {});
        ASSERT_EQ(grid.trials.size(), 5u);
        EXPECT_EQ(std::ranges::count_if(grid.trials, [&](auto& trial) { return std::abs(grid.edges(trial) - level_in_edges) < 1e-12; }), 1);
        EXPECT_TRUE(std::ranges::is_sorted(grid.trials, {}, &NoisyTrial::sigma));
    }
}

// Smoothing spreads spikes on few vertices over their neighbours; noise along the normals has no vertex without noise.
TEST(DenoisingGrid, OtherNoiseHasTheSameStrengthAndSmoothing) {
    const DenoisingGrid grid = grid_on(icosphere(3), "ball_spikes");
    ASSERT_EQ(grid.other_noise.size(), 2u);
    const OtherNoise &normal = grid.other_noise[0], &impulsive = grid.other_noise[1];
    EXPECT_EQ(normal.kind, NoiseKind::normal);
    EXPECT_TRUE(std::isnan(normal.spread));
    for (const OtherNoise& other : grid.other_noise) EXPECT_GE(other.best, other.same);
    EXPECT_GT(impulsive.spread, 0);
    EXPECT_LT(impulsive.spread, 1);
}

}   // namespace meshfolio::q7_denoising
