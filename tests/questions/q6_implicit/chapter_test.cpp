#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {
using namespace testing_tools;

TEST(Q6, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = chapter_of_id("q6").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(Q6, AbsurdStepsStayStable) {
    QuestionSettings settings = quick_settings();
    settings.lambda = {1e9};
    const Answer answer = chapter_of_id("q6").answer(library_of(icosphere(2), "ball6"), settings, no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(Q6, TheTablesAreTheStudy) {
    const TriangleMesh mesh = ellipsoid_mesh(2, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "egg6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "egg6"), quick_settings());
    const report::Table& table = table_named(answer.section, "q6_egg6_grid");
    const double percent = 100 / bounding_box(mesh).diagonal();
    std::vector<double> tau, iterations, energy, moved, volume;
    for (const SmoothingCell& cell : study.grid) {
        tau.push_back(cell.lambda / study.subject.critical);
        iterations.push_back(cell.iterations);
        energy.push_back(cell.implicit_energy);
        moved.push_back(percent * vertex_rms(study.subject.mesh().X, cell.implicit_X));
        volume.push_back(100 * cell.volume_ratio);
    }
    expect_near(numbers(table, "λ/λ_crit"), tau);
    expect_near(numbers(table, "iterations"), iterations);
    expect_near(numbers(table, "energy, implicit"), energy);
    expect_near(numbers(table, "moved, implicit (rms)"), moved, 1e-6);
    expect_near(numbers(table, "volume, implicit"), volume);
    const std::vector<report::Cell> gap = cells(table, "gap"), explicit_energy = cells(table, "energy, explicit");
    for (std::size_t i = 0; i < study.grid.size(); ++i) {
        const SmoothingCell& cell = study.grid[i];
        EXPECT_EQ(std::holds_alternative<double>(gap[i]), cell.explicit_X.size() > 0) << i;
        if (cell.explicit_X.size() == 0) continue;
        EXPECT_NEAR(std::get<double>(gap[i]), percent * vertex_rms(cell.implicit_X, cell.explicit_X), 1e-6 * std::get<double>(gap[i]));
        EXPECT_EQ(std::get<double>(explicit_energy[i]), cell.explicit_energy);
    }
    const report::Table& costs = table_named(answer.section, "q6_cost");
    EXPECT_EQ(numbers(costs, "implicit steps")[0], study.cost.implicit_steps);
    EXPECT_EQ(numbers(costs, "explicit steps")[0], study.cost.explicit_steps);
    expect_near(numbers(costs, "implicit λ/λ_crit"), {50});
}

TEST(Q6, PanelsAreWhatTheirLabelsSay) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "panels6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "panels6"), quick_settings());
    ASSERT_EQ(answer.figures.size(), 4u);   // steps, pairs, iterations, before and after
    EXPECT_TRUE(answer.figures[3].layout == output::Layout::comparison && answer.figures[3].turnable);
    const std::vector<output::Panel>&steps = answer.figures[0].panels, &pairs = answer.figures[1].panels, &times = answer.figures[2].panels;
    for (const output::FigureRequest& figure : answer.figures) EXPECT_EQ(figure.panels[0].mesh->X, study.subject.mesh().X) << figure.id;
    ASSERT_EQ(steps.size(), study.lambdas.size() + 1);
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        EXPECT_EQ(steps[l + 1].mesh->X, study.cell(l, study.middle_iteration()).implicit_X);
    }
    EXPECT_EQ(pairs[1].mesh->X, study.cell(0, study.middle_iteration()).explicit_X);
    EXPECT_EQ(pairs[1].label.rfind("explicit, λ = ", 0), 0u);
    EXPECT_EQ(pairs[2].mesh->X, study.cell(0, study.middle_iteration()).implicit_X);
    EXPECT_EQ(pairs[2].label.rfind("implicit, λ = ", 0), 0u);
    ASSERT_EQ(times.size(), study.iterations.size() + 1);
    for (std::size_t t = 0; t < study.iterations.size(); ++t) {
        EXPECT_EQ(times[t + 1].mesh->X, study.cell(1, t).implicit_X);
        EXPECT_NE(times[t + 1].label.find("t = " + std::to_string(study.iterations[t])), std::string::npos);
    }
}

TEST(Q6, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(chapter_of_id("q6").answer(library_of(mesh, "body6"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

TEST(Q6, EveryRealMesh) { check_real_meshes(chapter_of_id("q6").answer); }

}   // namespace meshfolio::q6_implicit
