#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/q6_implicit/parts.h"

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
    ASSERT_EQ(costs.rows.size(), study.costs.size());
    for (std::size_t i = 0; i < study.costs.size(); ++i) {
        const SmoothingCell& cell = study.grid[study.costs[i].cell];
        EXPECT_EQ(numbers(costs, "t")[i], cell.iterations);
        EXPECT_EQ(numbers(costs, "energy")[i], 100 * cell.implicit_energy);
        EXPECT_EQ(numbers(costs, "size")[i], 100 * cell.kept);
        EXPECT_EQ(numbers(costs, "explicit steps")[i], study.costs[i].explicit_steps);
        EXPECT_EQ(numbers(costs, "price, explicit")[i], study.costs[i].ratio());
    }
}

/// The figure of this id; each test has one mesh.
const output::FigureRequest& figure_named(const Answer& answer, const std::string& id) {
    const auto found = std::ranges::find(answer.figures, id, &output::FigureRequest::id);
    if (found == answer.figures.end()) throw std::logic_error("no figure " + id);
    return *found;
}

TEST(Q6, CellsOfTheMatrixAreTheStatesOfTheRuns) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "matrix6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "matrix6"), quick_settings());
    const output::FigureRequest& matrix = figure_named(answer, "q6_matrix6_matrix");
    EXPECT_EQ(matrix.layout, output::Layout::one_frame);
    ASSERT_EQ(matrix.rows.size(), study.lambdas.size());
    ASSERT_EQ(matrix.columns.size(), study.iterations.size());
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        EXPECT_NE(matrix.rows[l].find(in_limits(study.subject, study.lambdas[l])), std::string::npos);
        const SmoothingRun run =
            run_smoothing(study.subject, SmoothingScheme::implicit_euler, study.lambdas[l], study.iterations.back(), study.iterations);
        for (std::size_t t = 0; t < study.iterations.size(); ++t)
            EXPECT_EQ(matrix.panels[l * study.iterations.size() + t].mesh->X, run.snapshots[t]);
    }
}

TEST(Q6, ViewsShowTheInputTheRecommendedCellAndTooMuch) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "views6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "views6"), quick_settings());
    const output::FigureRequest& views = figure_named(answer, "q6_views6_views");
    EXPECT_TRUE(views.layout == output::Layout::six_views && views.turnable);
    ASSERT_EQ(views.panels.size(), 3u);
    EXPECT_EQ(views.panels[0].mesh->X, study.subject.mesh().X);
    EXPECT_EQ(views.panels[1].mesh->X, study.good()->implicit_X);
    EXPECT_EQ(views.panels[2].mesh->X, study.too_much()->implicit_X);
    EXPECT_EQ(views.panels[2].label.rfind("too much", 0), 0u);
}

TEST(Q6, ExplicitStandsAboveImplicitUntilItBlowsUp) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "pairs6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "pairs6"), quick_settings());
    const std::vector<const SmoothingCell*> cells = compared_cells(study);
    const output::FigureRequest& pairs = figure_named(answer, "q6_pairs6_pairs");
    ASSERT_EQ(pairs.columns.size(), cells.size());
    int blown = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const output::Panel &above = pairs.panels[i], &below = pairs.panels[cells.size() + i];
        EXPECT_EQ(below.mesh->X, cells[i]->implicit_X);
        blown += cells[i]->has_explicit() ? 0 : 1;
        if (cells[i]->has_explicit()) {
            EXPECT_EQ(above.mesh->X, cells[i]->explicit_X);
        } else {
            EXPECT_EQ(above.label, "blew up in iteration " + std::to_string(cells[i]->explicit_blow_up));
        }
    }
    EXPECT_EQ(blown, 1) << "5 λ_crit blows up, and is left there";
    EXPECT_EQ(pairs.frame_panel, static_cast<int>(cells.size())) << "spikes must not shrink the others";
}

TEST(Q6, LongTablesAreInTheAppendix) {
    const Answer answer = chapter_of_id("q6").answer(library_of(cube_mesh(6), "box6"), quick_settings(), no_progress);
    const report::Section& section = answer.section;
    ASSERT_GT(section.appendix_from, 0);
    for (std::size_t i = 0; i < section.blocks.size(); ++i)
        if (const auto* table = std::get_if<report::Table>(&section.blocks[i])) {
            EXPECT_EQ(table->id.ends_with("_grid"), static_cast<int>(i) >= section.appendix_from) << table->id;
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
