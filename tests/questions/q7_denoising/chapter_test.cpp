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

TEST(Q7, WhereNothingHelpsTheReportSaysSo) {
    QuestionSettings settings = quick_settings();
    settings.noise = {1e-6};
    const Answer answer = chapter_of_id("q7").answer(library_of(cube_mesh(6), "nearly_clean"), settings, no_progress);
    expect_well_formed(answer);
    for (const report::Cell& cell : cells(table_named(answer.section, "q7_results"), "verdict"))
        EXPECT_EQ(std::get<std::string>(cell), "no gain");
    EXPECT_NE(prose_of(answer.section).find("is halved in 0 of 1 case and falls by a sixth or more in 0"), std::string::npos);
}

TEST(Q7, TheTableIsTheStudy) {
    const TriangleMesh mesh = cube_mesh(6);
    const Answer answer = chapter_of_id("q7").answer(library_of(mesh, "box_table"), quick_settings(), no_progress);
    const DenoisingGrid grid = denoising_grid(library_mesh(mesh, "box_table"), quick_settings());
    const report::Table& table = table_named(answer.section, "q7_results");
    const double percent = 100 / bounding_box(mesh).diagonal();
    std::vector<double> noisy, best, gain;
    for (const NoisyTrial& trial : grid.trials) {
        for (const Measure& measure : measures) {
            const double unit = measure.key == "normals" ? 180 / M_PI : percent;
            noisy.push_back(unit * (trial.found.noisy.*measure.error));
            best.push_back(unit * (trial.best_by(measure).*measure.error));
            gain.push_back(noisy.back() / best.back());
        }
    }
    expect_near(numbers(table, "σ", "% of box"), {0.3, 0.3, 0.3, 1, 1, 1});
    expect_near(numbers(table, "noisy"), noisy);
    expect_near(numbers(table, "best"), best);
    expect_near(numbers(table, "gain"), gain, 1e-9);
}

TEST(Q7, ABestIterationThatIsTheLastIsToldAsSuch) {
    QuestionSettings settings = quick_settings();
    const auto is_told = [&](double noise) {
        settings.noise = {noise};
        settings.iterations = {1};
        const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(2), "ball_ended"), settings, no_progress);
        return table_named(answer.section, "q7_results").caption.find("is the first or last tried") != std::string::npos;
    };
    EXPECT_TRUE(is_told(0.03)) << "one step of many";
    EXPECT_FALSE(is_told(1e-9)) << "none is better";
}

TEST(Q7, PanelsAreCleanNoisyBestAndSmoothedOn) {
    const Answer answer = chapter_of_id("q7").answer(library_of(icosphere(3), "ball_panels"), quick_settings(), no_progress);
    const DenoisingGrid grid = denoising_grid(library_mesh(icosphere(3), "ball_panels"), quick_settings());
    ASSERT_EQ(answer.figures.size(), grid.trials.size() + 1);   // and before beside after
    EXPECT_EQ(answer.figures[0].id, "q7_ball_panels_sigma00300");
    for (std::size_t i = 0; i < grid.trials.size(); ++i) {
        const std::vector<output::Panel>& panels = answer.figures[i].panels;
        const NoisyTrial& trial = grid.trials[i];
        ASSERT_EQ(panels.size(), 4u);
        EXPECT_EQ(panels[0].mesh->X, grid.clean->mesh().X);
        EXPECT_EQ(panels[1].mesh->X, trial.noisy.X);
        EXPECT_EQ(panels[2].mesh->X, trial.best.X);
        EXPECT_EQ(panels[3].mesh->X, trial.over.X);
        EXPECT_NEAR(std::sqrt(panels[1].values.squaredNorm() / double(panels[1].values.size())),
                    100 * trial.found.noisy.shape / grid.diagonal, 1e-9);
    }
    const output::FigureRequest& pair = answer.figures.back();
    EXPECT_TRUE(pair.layout == output::Layout::comparison && pair.turnable);
    const auto most = std::ranges::max_element(grid.trials, {}, [](const NoisyTrial& t) { return t.gain(measures[0]); });
    EXPECT_EQ(pair.panels[0].mesh->X, most->noisy.X);
    EXPECT_EQ(pair.panels[1].mesh->X, most->best.X);
}

TEST(Q7, NoiseWithinAPlaneHasNoVerdictOnTheSurface) {
    EXPECT_EQ(verdict_on(std::nan("")), "–");
    EXPECT_EQ(verdict_on(2), "works");
    EXPECT_EQ(verdict_on(1.2), "helps");
    EXPECT_EQ(verdict_on(1.1), "fails");
    EXPECT_EQ(verdict_on(1), "no gain");
}

TEST(Q7, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(chapter_of_id("q7").answer(library_of(mesh, "body7"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

TEST(Q7, EveryRealMesh) { check_real_meshes(chapter_of_id("q7").answer); }

}   // namespace meshfolio::q7_denoising
