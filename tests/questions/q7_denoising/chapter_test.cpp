#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/measures/mesh_error.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/q7_denoising/parts.h"

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

TEST(Q7, TheReportSaysWhereNothingHelps) {
    QuestionSettings settings = quick_settings();
    settings.noise = {1e-6};
    const Answer answer = chapter_of_id("q7").answer(library_of(cube_mesh(6), "nearly_clean"), settings, no_progress);
    expect_well_formed(answer);
    for (const report::Cell& cell : cells(table_named(answer.section, "q7_results"), "verdict"))
        EXPECT_EQ(std::get<std::string>(cell), "fails");
    EXPECT_EQ(numbers(table_named(answer.section, "q7_counts"), "fails").front(), 1) << "by surface distance";
    EXPECT_NE(prose_of(answer.section).find("Smoothing fails here"), std::string::npos);
    const std::vector<output::Panel>& states = answer.figures.front().panels;
    EXPECT_TRUE(states[0].mesh && states[1].mesh && !states[2].mesh && !states[3].mesh) << "clean and noisy alone";
}

TEST(Q7, TheTablesAreTheStudy) {
    const TriangleMesh mesh = cube_mesh(6);
    const Answer answer = chapter_of_id("q7").answer(library_of(mesh, "box_table"), quick_settings(), no_progress);
    const DenoisingGrid grid = denoising_grid(library_mesh(mesh, "box_table"), quick_settings());
    const report::Table& table = table_named(answer.section, "q7_measures");
    const double percent = 100 / bounding_box(mesh).diagonal();
    std::vector<double> noisy, best, gain, surface, places, normals;
    for (const NoisyTrial& trial : grid.trials) {
        for (const Measure& measure : measures) {
            const double unit = measure.key == "normals" ? 180 / M_PI : percent;
            noisy.push_back(unit * (trial.found.noisy.*measure.error));
            best.push_back(unit * (trial.best_by(measure).*measure.error));
            gain.push_back(noisy.back() / best.back());
        }
        surface.push_back(trial.found.gain());
        places.push_back(trial.found.rms_gain());
        normals.push_back(trial.found.angle_gain());
    }
    expect_near(numbers(table, "σ", "% of box"), {0.3, 0.3, 0.3, 1, 1, 1});
    expect_near(numbers(table, "noisy"), noisy);
    expect_near(numbers(table, "best"), best);
    expect_near(numbers(table, "gain"), gain, 1e-9);
    const report::Table& short_table = table_named(answer.section, "q7_results");
    expect_near(numbers(short_table, "σ", "% of box"), {0.3, 1});
    expect_near(numbers(short_table, "gain: surface"), surface);
    expect_near(numbers(short_table, "places"), places);
    expect_near(numbers(short_table, "normals"), normals);
    const report::Table& remains = table_named(answer.section, "q7_remains");
    expect_near(numbers(remains, "removed along"), {100 * grid.pictured().removed_along()});
    expect_near(numbers(remains, "across"), {100 * grid.pictured().removed_across()});
    expect_near(numbers(remains, "clean: volume"), {100 * grid.pictured().taken.volume});
}

TEST(Q7, ABestIterationThatIsTheLastIsReportedAsSuch) {
    QuestionSettings settings = quick_settings();
    const auto is_told = [&](double noise) {
        settings.noise = {noise};
        settings.iterations = {1};
        const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(2), "ball_ended"), settings, no_progress);
        return table_named(answer.section, "q7_measures").caption.find("may gain more") != std::string::npos;
    };
    EXPECT_TRUE(is_told(0.03)) << "one step of many";
    EXPECT_FALSE(is_told(1e-9)) << "none is better";
}

TEST(Q7, PanelsAreCleanNoisyBestAndSmoothedOn) {
    const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(3), "ball_panels"), quick_settings(), no_progress);
    const Grids grids{denoising_grid(library_mesh(icosphere(3), "ball_panels"), quick_settings())};
    const DenoisingGrid& grid = grids[0];
    ASSERT_EQ(answer.figures.size(), 3u);
    const output::FigureRequest &states = answer.figures[0], &views = answer.figures[1], &limits = answer.figures[2];
    const NoisyTrial& seen = grid.pictured();
    const std::vector<Case> pictured = pictured_cases(grids);
    ASSERT_EQ(states.panels.size(), 4 * pictured.size());
    ASSERT_EQ(states.rows.size(), pictured.size());
    for (std::size_t i = 0; i < pictured.size(); ++i) {
        const NoisyTrial& trial = pictured[i].part;
        const output::Panel* row = &states.panels[4 * i];
        EXPECT_EQ(row[0].mesh->X, grid.clean->mesh().X);
        EXPECT_EQ(row[1].mesh->X, trial.noisy.X);
        EXPECT_EQ(row[2].mesh->X, trial.best.X);
        EXPECT_EQ(row[3].mesh->X, trial.over.X);
        const Vector& distances = row[1].values;
        EXPECT_NEAR(std::sqrt(distances.squaredNorm() / double(distances.size())), trial.found.noisy.shape / trial.sigma, 1e-9);
        EXPECT_EQ(views.panels[0].values == row[2].values, &trial == &seen);
    }
    ASSERT_EQ(views.panels.size(), 1u);

    ASSERT_EQ(limits.panels.size(), 2u) << "a ball has no edges";
    EXPECT_EQ(limits.panels[0].mesh->X, seen.best.X);
    EXPECT_EQ(limits.panels[1].mesh->X, seen.clean_alike.X);
}

TEST(Q7, CasesStandBesideEachOtherWhereTheyAreMoreThanTheirStates) {
    const Answer answer = chapter_of_id("q7").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    const output::FigureRequest& states = answer.figures.front();
    ASSERT_EQ(states.panels.size(), states.columns.size() * states.rows.size());
    const bool beside = states.rows.front() == "clean";
    EXPECT_EQ((beside ? states.rows : states.columns).size(), 4u);
    EXPECT_EQ(beside, states.panels.size() > 16);
    for (std::size_t i = 0; i < states.panels.size() / 4; ++i) {   // the clean meshes, and the name of each with its case
        const output::Panel& clean = states.panels[beside ? i : 4 * i];
        const std::string name = (beside ? states.columns : states.rows)[i];
        EXPECT_TRUE(clean.label.ends_with("clean")) << clean.label;
        EXPECT_EQ(name.substr(0, name.find(',')), clean.label.substr(0, clean.label.find(',')));
    }
}

TEST(Q7, AnOpenSheetHasNoVolumeToLose) {
    const Answer answer = chapter_of_id("q7").answer(library_of(grid_mesh(9, 9, 1, 1), "sheet7"), quick_settings(), no_progress);
    expect_well_formed(answer);
    EXPECT_EQ(prose_of(answer.section).find("volume: clean"), std::string::npos);
    EXPECT_EQ(prose_of(answer.section).find("lost volume"), std::string::npos);
}

TEST(Q7, NoiseWithinAPlaneHasNoVerdictOnTheSurface) {
    NoisyTrial trial;
    trial.found.noisy.rms = trial.found.by_rms.rms = 1;
    EXPECT_EQ(verdict_on(trial), "–") << "no distance to the surface";
    EXPECT_EQ(verdict_on(trial, measures[1]), "fails");
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

TEST(Q7, AVerdictWeighsTheVolume) {
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

TEST(Q7, EachVerdictWeighsTheVolumeAtItsOwnBest) {
    NoisyTrial trial;
    trial.clean_volume = 1;
    trial.found.noisy = {.shape = 3, .rms = 3, .angle = 3};
    trial.found.by_shape = {.step = 1, .shape = 1, .volume = 0.9};
    trial.found.by_rms = {.step = 2, .rms = 1, .volume = 0.8};
    trial.found.by_angle = {.step = 3, .angle = 2, .volume = 0.86};
    EXPECT_EQ(verdict_on(trial, measures[0]), "works");
    EXPECT_EQ(verdict_on(trial, measures[1]), "shrinks");
    EXPECT_EQ(verdict_on(trial, measures[2]), "helps");
    EXPECT_TRUE(is_failure("shrinks") && is_failure("fails"));
    EXPECT_FALSE(is_failure("works") || is_failure("helps") || is_failure("–"));
}

TEST(Q7, TheVolumeOfAStateIsThatOfItsMesh) {
    const DenoisingGrid grid = denoising_grid(library_mesh(cube_mesh(6), "box_volume"), quick_settings());
    for (const NoisyTrial& trial : grid.trials)
        EXPECT_NEAR(trial.volume_by(measures[0]), signed_volume(trial.best) / signed_volume(grid.clean->mesh()), 1e-12);
    const DenoisingGrid sheet = denoising_grid(library_mesh(grid_mesh(6, 6, 1, 1), "sheet_volume"), quick_settings());
    EXPECT_TRUE(std::isnan(sheet.trials[0].volume_by(measures[0])));
}

TEST(Q7, FiguresOfTheSameMeshesHaveTheSameColours) {
    const Answer answer = chapter_of_id("q7").answer(library_of(cube_mesh(6), "colours7"), quick_settings(), no_progress);
    ASSERT_EQ(answer.figures[0].id, "q7_states");
    ASSERT_EQ(answer.figures[1].id, "q7_views");
    EXPECT_EQ(answer.figures[0].range->high, answer.figures[1].range->high);
    EXPECT_EQ(answer.figures[0].range->quantity, answer.figures[1].range->quantity);
}

TEST(Q7, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(chapter_of_id("q7").answer(library_of(mesh, "body7"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

}   // namespace meshfolio::q7_denoising
