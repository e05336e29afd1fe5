#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"
#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {
using namespace testing_tools;

namespace {

Experiment experiment_of(ExperimentKind kind, int row) {
    Experiment e;
    e.rows = {row};
    e.from = "S0";
    e.name = "A small one";
    e.kind = kind;
    e.said = "It works.";
    e.lost = "Everything.";
    if (kind != ExperimentKind::forms) e.meshes = {{"ball", "no_such_ball.off", "cube8.obj", 0.25, 1.1, 1.7}};
    e.lambda = {1e-3, 1e-2};
    e.iterations = {2, 10};
    e.k = {2, 5};
    e.noise = {0.01, 0.02};
    e.minimum = {0, 2};
    e.colours = {ExperimentColour::gauss};
    return e;
}

QuestionSettings settings_with(const std::vector<Experiment>& experiments) {
    QuestionSettings settings = quick_settings();
    settings.experiments = settings.bundled_experiments = experiments;
    settings.own_experiments = true;
    return settings;
}

const std::vector<ExperimentKind> kinds{ExperimentKind::curvature, ExperimentKind::forms,     ExperimentKind::reconstruction,
                                        ExperimentKind::smoothing, ExperimentKind::denoising, ExperimentKind::error_curve};

std::vector<Experiment> one_of_each() {
    std::vector<Experiment> all;
    for (const ExperimentKind kind : kinds) all.push_back(experiment_of(kind, 20));
    return all;
}

/// The text of a cell in the row of a requirement in the coverage table; empty for an empty cell.
std::string covered(const report::Table& table, int row, const std::string& column) {
    const auto rows = numbers(table, "row");
    const auto column_cells = cells(table, column);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i] != row) continue;
        const auto* text = std::get_if<std::string>(&column_cells[i]);
        return text != nullptr ? *text : "";
    }
    return "no such row";
}

const report::Check& check_named(const report::Section& section, std::string_view name) {
    const auto check = std::ranges::find(section.checks, name, &report::Check::name);
    if (check == section.checks.end()) throw std::logic_error("no check " + std::string(name));
    return *check;
}

}   // namespace

TEST(Reproductions, EachKindIsWellFormedOnItsStandIn) {
    QuestionSettings settings = settings_with(one_of_each());
    settings.bundled_experiments.clear();   // six experiments do not cover the requirements
    const Answer answer = chapter_of_id("reproductions").answer(MeshLibrary({}, {}), settings, no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    const std::string prose = prose_of(answer.section);
    EXPECT_NE(prose.find("cube8.obj (8 vertices) in place of no_such_ball.off"), std::string::npos) << prose;
    EXPECT_NE(prose.find("It works."), std::string::npos);
    EXPECT_NE(prose.find("Everything."), std::string::npos);
    EXPECT_NE(prose.find("the same multiples"), std::string::npos);
    EXPECT_TRUE(answer.section.warnings.empty());
}

TEST(Reproductions, EachKindIsWellFormedOnAnOpenMeshOfTheUser) {
    QuestionSettings settings = settings_with(one_of_each());
    settings.bundled_experiments.clear();
    const TriangleMesh plane = make_sample("plane");
    const Answer answer = chapter_of_id("reproductions").answer(library_of(plane, "my_plane"), settings, no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_NE(prose_of(answer.section).find("my_plane"), std::string::npos);
}

TEST(Reproductions, AnImpossibleExperimentIsReportedAndTheOthersRun) {
    Experiment impossible = experiment_of(ExperimentKind::smoothing, 21);
    impossible.methods = {{SmoothingScheme::taubin, false}};
    impossible.lambda = {1e6};   // no Taubin step inflates again after it
    QuestionSettings settings = settings_with({impossible, experiment_of(ExperimentKind::curvature, 9)});
    settings.bundled_experiments.clear();
    const Answer answer = chapter_of_id("reproductions").answer(MeshLibrary({}, {}), settings, no_progress);
    expect_well_formed(answer);
    EXPECT_TRUE(answer.section.warnings.empty()) << "a failure is no warning";
    EXPECT_EQ(check_named(answer.section, "experiments that could not be done").measured, 1);
    EXPECT_FALSE(check_named(answer.section, "experiments that could not be done").passed());
    EXPECT_NE(prose_of(answer.section).find("Could not be done"), std::string::npos);
    EXPECT_NE(report::plain(answer.section.answer).find("1 experiment could not be done"), std::string::npos);
    const report::Table& coverage = table_named(answer.section, "reproductions_coverage");
    EXPECT_EQ(covered(coverage, 9, "done here"), "S0 (1)");
    EXPECT_EQ(covered(coverage, 21, "done here"), "");
    EXPECT_EQ(covered(coverage, 21, "could not be done"), "S0 (1)");
    EXPECT_EQ(answer.figures.size(), 1u);
}

TEST(Reproductions, ARunThatCollapsesKeepsItsMeasurements) {
    Experiment e = experiment_of(ExperimentKind::error_curve, 29);
    e.meshes = {{"creature", "no_such_creature.off", "creature.obj", 0, 0, 0}};
    e.methods = {{SmoothingScheme::implicit_euler, true}};
    e.lambda = {1};
    e.lambda_unit = StepUnit::h2;
    e.iterations = {2, 60};
    e.noise = {0.01};
    e.noise_unit = NoiseUnit::box;
    e.minimum = {2};
    const NoisyRun run = noisy_experiment(MeshLibrary({}, {}), e, quick_settings()).results.front();
    ASSERT_GT(run.collapse_iteration, 2);
    EXPECT_EQ(int(run.rms.size()), run.collapse_iteration) << "before any step, and after each that was made";
    EXPECT_LT(run.best, run.collapse_iteration);
    const Answer answer = chapter_of_id("reproductions").answer(MeshLibrary({}, {}), settings_with({e}), no_progress);
    expect_well_formed(answer);
    EXPECT_TRUE(check_named(answer.section, "experiments that could not be done").passed());
    const std::string outcome = std::get<std::string>(cells(table_named(answer.section, "reproductions_01_errors"), "outcome").front());
    EXPECT_NE(outcome.find("collapsed at step " + std::to_string(run.collapse_iteration)), std::string::npos) << outcome;
    const auto plot = std::ranges::find_if(answer.section.blocks, [](auto& block) { return std::holds_alternative<report::Plot>(block); });
    ASSERT_NE(plot, answer.section.blocks.end());
    const report::Marker& end = std::get<report::Plot>(*plot).markers.back();
    EXPECT_EQ(end.x, run.collapse_iteration - 1);
    EXPECT_EQ(end.label, "collapsed at step " + std::to_string(run.collapse_iteration));
}

TEST(Coverage, ListsExperimentsAndSectionsForEachRow) {
    const std::vector<Experiment> bundled{experiment_of(ExperimentKind::smoothing, 20), experiment_of(ExperimentKind::smoothing, 20),
                                          experiment_of(ExperimentKind::curvature, 22)};
    const report::Table table = coverage_table(bundled, {bundled[2]}, {});
    ASSERT_EQ(table.rows.size(), 28u) << "rows 7 to 34";
    EXPECT_EQ(covered(table, 20, "experiments of"), "S0 (2)");
    EXPECT_EQ(covered(table, 20, "done here"), "");
    EXPECT_EQ(covered(table, 22, "experiments of"), "S0 (1)");
    EXPECT_EQ(covered(table, 22, "done here"), "S0 (1)");
    EXPECT_EQ(covered(table, 12, "answered in"), "Q2");
    EXPECT_EQ(covered(table, 10, "remark").find("the dragon"), 0u);
}

TEST(Coverage, ARowWithoutAnAnswerFailsTheCheck) {
    const std::vector<Experiment> some{experiment_of(ExperimentKind::smoothing, 22)};
    const std::vector<int> missing = uncovered_rows(some);
    EXPECT_EQ(std::count(missing.begin(), missing.end(), 22), 0);
    EXPECT_EQ(std::count(missing.begin(), missing.end(), 33), 1);
    EXPECT_EQ(std::count(missing.begin(), missing.end(), 12), 0) << "question 2 answers it";
    const Answer answer = chapter_of_id("reproductions").answer(MeshLibrary({}, {}), settings_with(some), no_progress);
    EXPECT_FALSE(check_named(answer.section, "rows 7 to 34 that neither a bundled experiment nor a section answers").passed());
}

TEST(ReproductionWords, StateParametersAsTheReportDoes) {
    Experiment e = experiment_of(ExperimentKind::smoothing, 20);
    EXPECT_EQ(rows_text({20}), "row 20");
    EXPECT_EQ(rows_text({7, 8, 9}), "rows 7, 8 and 9");
    EXPECT_EQ(given_text(e, 0.05), "0.05");
    e.lambda_unit = StepUnit::tau;
    EXPECT_EQ(given_text(e, 0.5), "0.5 λ_crit");
    EXPECT_EQ(noise_text(e, 0.0013), "0.0013");
    e.noise_unit = NoiseUnit::box;
    EXPECT_EQ(noise_text(e, 0.01), "1\u202f% of the box");
    EXPECT_EQ(variant_text(e, {}), "explicit");
    EXPECT_EQ(variant_text(e, {.kind = OperatorKind::uniform, .method = {SmoothingScheme::implicit_euler, true}}),
              "implicit-rebuilt, uniform");
    EXPECT_EQ(range_text({2, 1, 1.5}), "1 to 2");
    EXPECT_EQ(range_text({1, 1}), "1");
    EXPECT_EQ(sentence_case("row 1"), "Row 1");
    EXPECT_EQ(sentence_case("λ"), "λ");
}

}   // namespace meshfolio::reproductions
