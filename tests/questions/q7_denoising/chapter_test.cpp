#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/measures/mesh_error.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/q7_denoising/study.h"

namespace meshfolio::q7_denoising {
using namespace testing_tools;

TEST(Q7, TheSeedDecidesTheNoise) {
    QuestionSettings settings = quick_settings();
    const MeshLibrary library = library_of(cube_mesh(6), "box7");
    const auto noisy = [&](std::uint64_t seed) {
        settings.seed = seed;
        return chapter_of_id("q7").answer(library, settings, no_progress).figures.front().panels[1].mesh->X;
    };
    EXPECT_EQ(noisy(1), noisy(1));
    EXPECT_NE(noisy(1), noisy(2));
}

TEST(Q7, TheReportNamesMeshesWithoutAGain) {
    QuestionSettings settings = quick_settings();
    settings.noise = {1e-6};
    const Answer answer = chapter_of_id("q7").answer(library_of(cube_mesh(6), "nearly_clean"), settings, no_progress);
    expect_well_formed(answer);
    for (const report::Cell& cell : cells(table_named(answer.section, "q7_results"), "verdict"))
        EXPECT_EQ(std::get<std::string>(cell), "fails");
    EXPECT_NE(prose_of(answer.section).find("it fails in 1"), std::string::npos);
    const std::vector<output::Panel>& states = answer.figures.front().panels;
    EXPECT_TRUE(states[0].mesh && states[1].mesh && !states[2].mesh && !states[3].mesh) << "clean and noisy alone";
}

TEST(Q7, TheTablesAreTheStudy) {
    const TriangleMesh mesh = cube_mesh(6);
    const Answer answer = chapter_of_id("q7").answer(library_of(mesh, "box_table"), quick_settings(), no_progress);
    const DenoisingGrid grid = denoising_grid(library_mesh(mesh, "box_table"), quick_settings());
    const report::Table &measured = table_named(answer.section, "q7_measures"), &table = table_named(answer.section, "q7_results");
    const auto gains = [&](const Measure& measure) { return each_of(grid.trials, [&](auto& trial) { return trial.gain(measure); }); };
    expect_near(numbers(table, "σ", "% of box"), {0.3, 1});
    expect_near(numbers(table, "gain"), gains(measures[0]));
    expect_near(numbers(measured, "surface: gain"), gains(measures[0]));
    expect_near(numbers(measured, "places: gain"), gains(measures[1]));
    expect_near(numbers(measured, "normals: gain"), gains(measures[2]));
    const report::Table& remains = table_named(answer.section, "q7_remains");
    expect_near(numbers(remains, "removed along"), {100 * grid.pictured().removed_along()});
    expect_near(numbers(remains, "across"), {100 * grid.pictured().removed_across()});
    expect_near(numbers(remains, "clean: volume"), {100 * grid.pictured().clean_loss.volume});
}

TEST(Q7, ABestIterationAtTheEndOfTheRunIsReported) {
    QuestionSettings settings = quick_settings();
    const auto is_told = [&](double noise) {
        settings.noise = {noise};
        settings.iterations = {1};
        const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(2), "ball_ended"), settings, no_progress);
        return table_named(answer.section, "q7_measures").caption.find("may gain more") != std::string::npos;
    };
    EXPECT_TRUE(is_told(0.3)) << "one step of the largest λ";
    EXPECT_FALSE(is_told(0.03)) << "one step of a λ between";
    EXPECT_FALSE(is_told(1e-9)) << "none is better";
}

TEST(Q7, PanelsAreCleanNoisyBestAndSmoothedFurther) {
    const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(3), "ball_panels"), quick_settings(), no_progress);
    const Grids grids{denoising_grid(library_mesh(icosphere(3), "ball_panels"), quick_settings())};
    const DenoisingGrid& grid = grids[0];
    ASSERT_EQ(answer.figures.size(), 3u);
    const output::FigureRequest &states = answer.figures[0], &views = answer.figures[1], &losses = answer.figures[2];
    const NoisyTrial &seen = grid.pictured(), &strongest = grid.trials.back();
    ASSERT_EQ(states.panels.size(), 4u);
    EXPECT_EQ(states.panels[0].mesh->X, grid.clean->mesh().X);
    EXPECT_EQ(states.panels[1].mesh->X, seen.noisy.X);
    EXPECT_EQ(states.panels[2].mesh->X, seen.best.X);
    EXPECT_EQ(states.panels[3].mesh->X, seen.over.X);
    const Vector& distances = states.panels[1].values;
    EXPECT_NEAR(std::sqrt(distances.squaredNorm() / double(distances.size())), seen.found.noisy.shape / seen.sigma, 1e-9);
    ASSERT_EQ(views.panels.size(), 1u);
    EXPECT_EQ(views.panels[0].mesh->F, strongest.best.F);
    ASSERT_EQ(losses.panels.size(), 1u) << "a ball has no edges";
    EXPECT_EQ(losses.panels[0].mesh->X, seen.clean_alike.X);
}

TEST(Q7, AnOpenSheetHasNoVolume) {
    const Answer answer = chapter_of_id("q7").answer(library_of(grid_mesh(9, 9, 1, 1), "sheet7"), quick_settings(), no_progress);
    expect_well_formed(answer);
    EXPECT_EQ(prose_of(answer.section).find("volume: clean"), std::string::npos);
    EXPECT_EQ(prose_of(answer.section).find("of its volume"), std::string::npos);
}

TEST(Q7, NoiseWithinAPlaneHasNoVerdict) {
    NoisyTrial trial;
    trial.found.noisy.rms = trial.found.by_rms.rms = 1;
    EXPECT_EQ(verdict_on(trial), "–") << "no distance to the surface";
    trial.found.noisy.shape = trial.found.by_shape.shape = 1;
    const auto verdict = [&](double gain) {
        trial.found.noisy.shape = gain;
        return verdict_on(trial);
    };
    EXPECT_EQ(verdict(2), "works");
    EXPECT_EQ(verdict(1.9999), "helps");
    EXPECT_EQ(verdict(1.1), "helps");
    EXPECT_EQ(verdict(1.0999), "fails") << "not rounded";
    EXPECT_EQ(verdict(1), "fails");
}

TEST(Q7, TheVerdictDependsOnTheVolume) {
    NoisyTrial trial;
    trial.found.noisy.shape = trial.found.noisy.rms = 3;
    trial.found.by_shape.step = 1;
    trial.clean_volume = 2;
    const auto verdict = [&](double error, double volume) {
        trial.found.by_shape.shape = error;
        trial.found.by_shape.volume = 2 * volume;
        return verdict_on(trial);
    };
    EXPECT_EQ(verdict(1, 1), "works");
    EXPECT_EQ(verdict(1, 0.851), "works");
    EXPECT_EQ(verdict(1, 0.849), "shrinks") << "not rounded";
    EXPECT_EQ(verdict(1, 0.8), "shrinks");
    EXPECT_EQ(verdict(1, std::nan("")), "works") << "an open sheet has none to lose";
    EXPECT_EQ(verdict(2, 0.8), "shrinks");
    EXPECT_EQ(verdict(2.9, 0.8), "fails");
}

TEST(Q7, TheVolumeOfAStateBelongsToItsMesh) {
    const DenoisingGrid grid = denoising_grid(library_mesh(cube_mesh(6), "box_volume"), quick_settings());
    for (const NoisyTrial& trial : grid.trials)
        EXPECT_NEAR(trial.volume_by(measures[0]), signed_volume(trial.best) / signed_volume(grid.clean->mesh()), 1e-12);
    const DenoisingGrid sheet = denoising_grid(library_mesh(grid_mesh(6, 6, 1, 1), "sheet_volume"), quick_settings());
    EXPECT_TRUE(std::isnan(sheet.trials[0].volume_by(measures[0])));
}

TEST(Q7, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(chapter_of_id("q7").answer(library_of(mesh, "body7"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

}   // namespace meshfolio::q7_denoising
