#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/q5_explicit/study.h"

namespace meshfolio::q5_explicit {
using namespace testing_tools;

TEST(Q5, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = chapter_of_id("q5").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    // Beyond the limit something must be told about growth.
    EXPECT_NE(prose_of(answer.section).find("Too large a step amplifies"), std::string::npos);
}

TEST(Q5, OnlyStepsBelowTheLimitAreRecommended) {
    QuestionSettings settings = quick_settings();
    settings.lambda = {1e3};   // far beyond the limit of a unit sphere
    const Answer answer = chapter_of_id("q5").answer(library_of(icosphere(2), "ball"), settings, no_progress);
    expect_well_formed(answer);
    EXPECT_NE(prose_of(answer.section).find("no step tried can be recommended"), std::string::npos);
}

TEST(Q5, TheTablesAreTheStudy) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q5").answer(library_of(mesh, "egg5"), quick_settings(), no_progress);
    const ExplicitStudy study = explicit_study(library_mesh(mesh, "egg5"), quick_settings());
    const report::Table& table = table_named(answer.section, "q5_egg5_sweep_table");
    const SmoothingSubject& subject = study.subject;
    const double h = subject.mean_edge;
    std::vector<double> tau, in_edges, energy, moved, volume, angle, inverted, predicted;
    for (const SmoothingRun& run : study.runs) {
        tau.push_back(run.lambda / subject.critical);
        in_edges.push_back(run.lambda / (h * h));
        energy.push_back(run.energy.back());
        moved.push_back(100 * vertex_rms(subject.mesh().X, run.result.X) / bounding_box(subject.mesh()).diagonal());
        volume.push_back(100 * signed_volume(moved_to(subject.mesh(), run.result.X)) / signed_volume(subject.mesh()));
        angle.push_back(corner_angles(moved_to(subject.mesh(), run.result.X)).minCoeff() * 180 / M_PI);
        inverted.push_back(run.moved.inverted_faces);
        const double factor = std::pow(std::abs(1 - run.lambda * subject.top.value), 20);
        predicted.push_back(factor < 1e-8 ? 0 : factor);
    }
    expect_near(numbers(table, "λ/λ_crit"), tau);
    expect_near(numbers(table, "λ/h̄²"), in_edges);
    expect_near(numbers(table, "energy"), energy);
    expect_near(numbers(table, "rms moved"), moved);
    expect_near(numbers(table, "volume"), volume, 1e-9);
    expect_near(numbers(table, "smallest angle"), angle, 1e-9);
    expect_near(numbers(table, "inverted faces"), inverted);
    expect_near(numbers(table, "top mode ×, predicted"), predicted, 1e-9);
    EXPECT_EQ(numbers(table, "iterations"), (std::vector<double>{20, 20, 20, 20, double(study.runs.back().result.iterations)}));
    std::vector<std::string> outcomes;
    for (const report::Cell& cell : cells(table, "outcome")) outcomes.push_back(std::get<std::string>(cell));
    EXPECT_EQ(outcomes[0], "stable");
    EXPECT_TRUE(outcomes[1].starts_with("recommended")) << outcomes[1];
    EXPECT_EQ(outcomes[2], "stable");
    EXPECT_EQ(outcomes[3], "growing");
    const report::Table& limits = table_named(answer.section, "q5_limits");
    expect_near(numbers(limits, "λ_crit"), {2 / subject.top.value});
    expect_near(numbers(limits, "λ_crit/h̄²"), {subject.critical / (h * h)});
    EXPECT_LE(numbers(limits, "safe λ (Gershgorin)")[0], subject.critical);
}

TEST(Q5, PanelsAreTheInputAndEveryStepInOrder) {
    const TriangleMesh mesh = cube_mesh(4);
    const Answer answer = chapter_of_id("q5").answer(library_of(mesh, "cube5"), quick_settings(), no_progress);
    const ExplicitStudy study = explicit_study(library_mesh(mesh, "cube5"), quick_settings());
    const std::vector<output::Panel>& panels = answer.figures.front().panels;
    ASSERT_EQ(panels.size(), study.runs.size() + 1);
    EXPECT_EQ(panels[0].label, "before");
    EXPECT_EQ(panels[0].mesh->X, study.subject.mesh().X);
    for (std::size_t i = 0; i < study.runs.size(); ++i) {
        EXPECT_EQ(panels[i + 1].mesh->X, study.runs[i].in_view);
        EXPECT_EQ(panels[i + 1].label.rfind("λ = " + step_label(study.subject, study.runs[i].lambda), 0), 0u);
    }
}

TEST(Q5, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(chapter_of_id("q5").answer(library_of(mesh, "body5"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

TEST(Q5, EveryRealMesh) { check_real_meshes(chapter_of_id("q5").answer); }

}   // namespace meshfolio::q5_explicit
