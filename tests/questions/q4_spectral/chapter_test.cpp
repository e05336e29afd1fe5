#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/measures/hausdorff.h"
#include "geometry/measures/mesh_error.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q4_spectral {
using namespace testing_tools;

namespace {

Answer answer_on(const TriangleMesh& mesh, const std::string& name, std::vector<int> k) {
    QuestionSettings settings = quick_settings();
    settings.k = std::move(k);
    return chapter_of_id("q4").answer(library_of(mesh, name), settings, no_progress);
}

}   // namespace

TEST(Q4, BundledMeshPassesItsOwnChecks) {
    const Answer answer = chapter_of_id("q4").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_EQ(answer.meshes.size(), answer.section.output_meshes.size());
}

TEST(Q4, AllModesGiveTheMeshBack) {
    const Answer answer = answer_on(torus_mesh(24, 12, 1, 0.4), "torus_all", {5, 24 * 12});
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_EQ(answer.meshes.back().name, "q4_torus_all_k288.ply");
    EXPECT_LT((answer.meshes.back().mesh->X - torus_mesh(24, 12, 1, 0.4).X).cwiseAbs().maxCoeff(), 1e-10);
    const report::Table& errors = table_named(answer.section, "q4_torus_all_errors");
    for (const char* column : {"rms", "maximum", "Hausdorff", "mean normal angle"}) {
        EXPECT_EQ(numbers(errors, column).back(), 0) << "rounding is no error: " << column;
        EXPECT_GT(numbers(errors, column).front(), 0.1) << column;
    }
    const std::vector<output::Panel>& panels = figure_named(answer, "q4_torus_all_reconstructions").panels;
    ASSERT_EQ(panels.size(), 2u) << "all modes look like the original: one picture for both";
    EXPECT_EQ(panels.front().label, "original; k = 288 looks the same");
}

TEST(Q4, MoreModesThanVerticesAreCut) {
    const Answer answer = answer_on(cube_mesh(1), "cube_few", {3, 5000});
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_EQ(table_named(answer.section, "q4_cube_few_errors").rows.size(), 2u);
}

TEST(Q4, TheErrorFallsWithK) {
    const Answer answer = answer_on(ellipsoid_mesh(3, {1.7, 1.1, 0.6}), "egg", {4, 9, 16, 25});
    const report::Table& table = table_named(answer.section, "q4_egg_errors");
    for (std::size_t i = 1; i < table.rows.size(); ++i)
        EXPECT_LT(std::get<double>(table.rows[i][1]), std::get<double>(table.rows[i - 1][1]));
}

TEST(Q4, TheTableHasTheErrorsOfTheMeshesWrittenOut) {
    const TriangleMesh mesh = ellipsoid_mesh(2, {1.7, 1.1, 0.6});
    const Answer answer = answer_on(mesh, "egg_table", {30, 6, 30});
    const report::Table& table = table_named(answer.section, "q4_egg_table_errors");
    EXPECT_EQ(numbers(table, "k"), (std::vector<double>{6, 30}));
    ASSERT_EQ(answer.meshes.size(), 2u);
    const double percent = 100 / bounding_box(mesh).diagonal();
    std::vector<double> rms, largest, hausdorff, angle, volume;
    for (const output::MeshOutput& written : answer.meshes) {
        const MeshDifference d = compare_meshes(mesh, *written.mesh);
        rms.push_back(percent * d.area_weighted_rms);
        largest.push_back(percent * d.max);
        hausdorff.push_back(percent * hausdorff_distance(mesh, *written.mesh).distance);
        angle.push_back(d.mean_normal_angle * 180 / M_PI);
        volume.push_back(100 * d.volume_ratio);
    }
    expect_near(numbers(table, "rms"), rms, 1e-5);   // the mesh went through a file
    expect_near(numbers(table, "maximum"), largest, 1e-5);
    expect_near(numbers(table, "Hausdorff"), hausdorff, 1e-5);
    expect_near(numbers(table, "mean normal angle"), angle, 1e-4);
    expect_near(numbers(table, "volume"), volume, 1e-5);
    const std::vector<double> off = numbers(table, "off");
    EXPECT_GE(off[0], off[1]) << "less of the area is off with more modes";
    EXPECT_LE(off[0], 100);
}

TEST(Q4, TheSphereHasItsKnownEigenvalues) {
    const Answer answer = answer_on(icosphere(2), "ball_waves", {9, 16});
    const report::Plot& plot = plot_named(answer.section, "q4_ball_waves_spectrum");
    EXPECT_EQ(plot.series.front().x.front(), 2) << "the constant has no wavelength";
    const std::vector<double>& mu = plot.series.front().y;
    EXPECT_NEAR(mu[0], 2, 0.05);   // l(l + 1) on the unit sphere
    EXPECT_NEAR(mu[9], 12, 0.8);
}

// Parseval: the squares of the coefficients beyond k add up to the squared error of k modes.
TEST(Q4, ThePlottedCoefficientsAddUpToTheError) {
    const Answer answer = answer_on(ellipsoid_mesh(2, {1.7, 1.1, 0.6}), "egg_parseval", {6, 162});
    const report::Plot& plot = plot_named(answer.section, "q4_egg_parseval_error_versus_k");
    const report::Series &error = plot.series[0], &coefficients = plot.series[2];
    double squares = 0;
    for (std::size_t i = 0; i < coefficients.x.size(); ++i)
        if (coefficients.x[i] > 6) squares += coefficients.y[i] * coefficients.y[i];
    EXPECT_NEAR(std::sqrt(squares) / error.y[5], 1, 1e-3);
}

TEST(Q4, TheReportShowsTheFirstTwoAndTheLargestKAndTheAppendixTheOthers) {
    const Answer answer = answer_on(icosphere(2), "ball_told", {5, 15, 30, 60, 90});
    EXPECT_EQ(figure_named(answer, "q4_ball_told_reconstructions").panels.size(), 4u);
    const std::vector<output::Panel>& further = figure_named(answer, "q4_ball_told_further").panels;
    ASSERT_EQ(further.size(), 2u);
    EXPECT_TRUE(further[0].label.starts_with("k = 30,")) << further[0].label;
    EXPECT_TRUE(further[1].label.starts_with("k = 60,")) << further[1].label;
    const auto& blocks = answer.section.blocks;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const auto* figure = std::get_if<report::Figure>(&blocks[i]);
        if (figure == nullptr) continue;
        EXPECT_EQ(static_cast<int>(i) >= answer.section.appendix_from, figure->id == "q4_ball_told_further") << figure->id;
    }
}

TEST(Q4, PanelsAreTheOriginalAndEveryKInOrder) {
    const Answer answer = answer_on(cube_mesh(4), "cube_panels", {20, 5});
    const std::vector<output::Panel>& panels = answer.figures.front().panels;
    ASSERT_EQ(panels.size(), 3u);
    EXPECT_EQ(panels[0].label, "original");
    EXPECT_EQ(panels[1].mesh->X, answer.meshes[0].mesh->X);
    const output::ColorRange& range = *answer.figures.front().range;   // one for all k, so that they can be compared
    EXPECT_TRUE(range.logarithmic);
    EXPECT_GT(range.low, 0);
    const double percent = 100 / bounding_box(*panels[0].mesh).diagonal();
    for (std::size_t i = 1; i < 3; ++i) {
        const Vector distance = (panels[i].mesh->X - panels[0].mesh->X).rowwise().norm();
        EXPECT_LT((panels[i].values - percent * distance).norm(), 1e-9 * panels[i].values.norm());
        EXPECT_TRUE(panels[i].label.starts_with("k = " + std::string(i == 1 ? "5" : "20") + ", rms ")) << panels[i].label;
    }
}

TEST(Q4, InertiaIsReportedOnlyIfModesMayBeMissing) {
    const auto message = [](int level) {
        const report::Section section = answer_on(icosphere(level), "ball_extent" + std::to_string(level), {5}).section;
        return std::pair(section.extent.find("inertia") != std::string::npos, prose_of(section).find("Sylvester") != std::string::npos);
    };
    EXPECT_EQ(message(2), std::pair(false, false)) << "a dense solver finds all";
    EXPECT_EQ(message(4), std::pair(true, true)) << "Lanczos iteration looks for the first";
}

TEST(Q4, TheTextFollowsTheData) {
    EXPECT_NE(prose_of(answer_on(cube_mesh(6), "body", {5, 20}).section), prose_of(answer_on(icosphere(2), "body", {5, 20}).section));
}

TEST(Q4, EveryRealMesh) {
    QuestionSettings settings = quick_settings();
    settings.k = {5, 20};
    check_real_meshes(chapter_of_id("q4").answer, settings);
}

}   // namespace meshfolio::q4_spectral
