#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/measures/mesh_error.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/bench/denoising_study.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q7_denoising {
using namespace testing_tools;

TEST(Q7, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = chapter_of_id("q7").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

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

TEST(Q7, WhereNoIterationHelpsTheReportSaysSo) {
    QuestionSettings settings = quick_settings();
    settings.noise = {1e-9};
    const Answer answer = chapter_of_id("q7").answer(library_of(cube_mesh(6), "nearly_clean"), settings, no_progress);
    expect_well_formed(answer);
    EXPECT_NE(prose_of(answer.section).find("no iteration is better than none"), std::string::npos);
}

TEST(Q7, TheTableIsTheStudy) {
    const TriangleMesh mesh = cube_mesh(6);
    const Answer answer = chapter_of_id("q7").answer(library_of(mesh, "box_table"), quick_settings(), no_progress);
    const DenoisingStudy study = denoising_study(library_mesh(mesh, "box_table"), quick_settings());
    const report::Table& table = table_named(answer.section, "q7_results");
    const double percent = 100 / bounding_box(mesh).diagonal();
    std::vector<double> sigma, noisy, best, last, angle, ratio;
    for (const DenoisingTrial& trial : study.trials) {
        sigma.push_back(trial.sigma / mean_edge_length(mesh));
        noisy.push_back(percent * vertex_rms(study.clean->mesh().X, trial.noisy.X));
        best.push_back(percent * vertex_rms(study.clean->mesh().X, trial.best.X));
        last.push_back(percent * vertex_rms(study.clean->mesh().X, trial.last.X));
        angle.push_back(compare_meshes(study.clean->mesh(), trial.noisy).mean_normal_angle * 180 / M_PI);
        ratio.push_back(trial.feature_rms / trial.smooth_rms);
    }
    expect_near(numbers(table, "σ", "% of box"), {0.3, 1});
    expect_near(numbers(table, "σ", "mean edges"), sigma, 1e-6);
    expect_near(numbers(table, "error, noisy"), noisy, 1e-6);
    expect_near(numbers(table, "error, best"), best, 1e-6);
    expect_near(numbers(table, "error, last"), last, 1e-6);
    expect_near(numbers(table, "normal angle, noisy"), angle, 1e-9);
    expect_near(numbers(table, "error at features / elsewhere"), ratio);
    for (std::size_t i = 0; i < best.size(); ++i) best[i] = noisy[i] / best[i];
    expect_near(numbers(table, "gain"), best, 1e-6);
}

TEST(Q7, ABestIterationThatIsTheLastIsNoMinimum) {
    QuestionSettings settings = quick_settings();
    const auto is_told = [&](double noise) {
        settings.noise = {noise};
        settings.iterations = {1};
        const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(2), "ball_ended"), settings, no_progress);
        return table_named(answer.section, "q7_results").caption.find("is no minimum") != std::string::npos;
    };
    EXPECT_TRUE(is_told(0.03)) << "one step of many";
    EXPECT_FALSE(is_told(1e-9)) << "none is better";
}

TEST(Q7, PanelsAreCleanNoisyBestAndSmoothedOn) {
    const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(2), "ball_panels"), quick_settings(), no_progress);
    const DenoisingStudy study = denoising_study(library_mesh(icosphere(2), "ball_panels"), quick_settings());
    ASSERT_GE(answer.figures.size(), study.trials.size());   // and before beside after
    EXPECT_EQ(answer.figures[0].id, "q7_ball_panels_sigma00300");
    EXPECT_EQ(answer.figures[1].id, "q7_ball_panels_sigma01000");
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        const std::vector<output::Panel>& panels = answer.figures[i].panels;
        const DenoisingTrial& trial = study.trials[i];
        ASSERT_EQ(panels.size(), trial.minimum_reached() ? 4u : 3u);
        EXPECT_EQ(panels[0].mesh->X, study.clean->mesh().X);
        EXPECT_EQ(panels[1].mesh->X, trial.noisy.X);
        EXPECT_EQ(panels[2].mesh->X, trial.best.X);
        if (trial.minimum_reached()) {
            EXPECT_EQ(panels[3].mesh->X, trial.last.X);
        }
        EXPECT_NEAR(std::sqrt(panels[1].values.squaredNorm() / double(panels[1].values.size())), 100 * trial.rms.front() / study.diagonal,
                    1e-9);
    }
}

TEST(Q7, BeforeAndAfterIsTheNoiseThatSmoothingDidMostAgainst) {
    const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(2), "ball_panels"), quick_settings(), no_progress);
    const DenoisingStudy study = denoising_study(library_mesh(icosphere(2), "ball_panels"), quick_settings());
    const DenoisingTrial& most = *std::max_element(study.trials.begin(), study.trials.end(),
                                                   [](const DenoisingTrial& a, const DenoisingTrial& b) { return a.gain() < b.gain(); });
    const bool helped = most.best_rms > 0;
    ASSERT_EQ(answer.figures.size(), study.trials.size() + (helped ? 1 : 0));
    if (!helped) return;
    const output::FigureRequest& figure = answer.figures.back();
    EXPECT_TRUE(figure.layout == output::Layout::comparison && figure.turnable);
    EXPECT_EQ(figure.panels[0].mesh->X, most.noisy.X);
    EXPECT_EQ(figure.panels[1].mesh->X, most.best.X);
}

TEST(Q7, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(chapter_of_id("q7").answer(library_of(mesh, "body7"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

TEST(Q7, EveryRealMesh) { check_real_meshes(chapter_of_id("q7").answer); }

}   // namespace meshfolio::q7_denoising
