#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {
using namespace testing_tools;

TEST(Q6, AbsurdStepsStayStable) {
    QuestionSettings settings = quick_settings();
    settings.lambda = {1e9};
    const Answer answer = chapter_of_id("q6").answer(library_of(icosphere(2), "ball6"), settings, no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(Q6, TheTablesAreTheStudy) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "egg6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "egg6"), quick_settings());
    const report::Table& table = table_named(answer.section, "q6_egg6_grid");
    const double percent = 100 / bounding_box(mesh).diagonal();
    std::vector<double> tau, iterations, energy, moved, volume;
    for (const SmoothingCell& cell : study.grid) {
        tau.push_back(cell.lambda / study.subject.critical);
        iterations.push_back(cell.iterations);
        energy.push_back(100 * cell.implicit_energy);
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
        EXPECT_EQ(std::get<double>(explicit_energy[i]), 100 * cell.explicit_energy);
    }
    const report::Table &costs = table_named(answer.section, "q6_cost"), &prices = table_named(answer.section, "q6_prices");
    ASSERT_TRUE(study.good() && study.cost);
    expect_near(numbers(costs, "t"), {double(study.good()->iterations)});
    expect_near(numbers(costs, "energy"), {100 * study.good()->implicit_energy});
    expect_near(numbers(costs, "size"), {100 * study.good()->kept});
    expect_near(numbers(costs, "explicit steps"), {double(study.cost->explicit_steps)});
    expect_near(numbers(costs, "price, explicit"), {study.cost->ratio});
    ASSERT_EQ(prices.rows.size(), study.lambdas.size());
    for (const int t : study.iterations) {
        const std::vector<report::Cell> priced = cells(prices, "t = " + std::to_string(t));
        for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
            const double price = study.price(l, t);
            ASSERT_EQ(std::holds_alternative<double>(priced[l]), !std::isnan(price));
            if (!std::isnan(price)) {
                EXPECT_EQ(std::get<double>(priced[l]), price);
            }
        }
    }
}

TEST(Q6, CellsOfTheMatrixAreTheStatesOfTheRuns) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "matrix6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "matrix6"), quick_settings());
    const output::FigureRequest& matrix = figure_named(answer, "q6_matrix6_matrix");
    EXPECT_EQ(matrix.layout, output::Layout::one_frame);
    ASSERT_EQ(matrix.columns.size(), 1 + study.iterations.size());
    ASSERT_EQ(matrix.rows.size(), 5u) << "both schemes up to 5 λ_crit, the first to blow up, then implicit alone";
    const SmoothingRun blown =
        run_smoothing(study.subject, SmoothingScheme::explicit_euler, study.lambdas[1], study.iterations.back(), study.iterations);
    ASSERT_EQ(blown.snapshots.size(), 1u);
    EXPECT_EQ(matrix.columns[0], "input, t = 0");
    EXPECT_EQ(matrix.panels[0].mesh->X, study.subject.mesh().X);
    EXPECT_EQ(matrix.panels[0].values, curvature_colours(study.subject, study.subject.mesh().X));
    const std::size_t width = matrix.columns.size();
    EXPECT_EQ(matrix.panels[2 * width + 1].mesh->X, blown.snapshots[0]) << "what the first step too large does";
    EXPECT_EQ(matrix.panels[2 * width + 2].label, "blew up in iteration " + std::to_string(blown.result.blow_up_iteration));
    for (std::size_t r = 1; r < matrix.rows.size(); ++r)
        EXPECT_TRUE(!matrix.panels[r * width].mesh && matrix.panels[r * width].label.empty()) << "the input stands there once";
    for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
        const bool is_explicit = matrix.rows[r].rfind("explicit", 0) == 0;
        EXPECT_EQ(is_explicit, r == 0 || r == 2);
        const double lambda = study.lambdas[r / 2];
        EXPECT_NE(matrix.rows[r].find(in_limits(study.subject, lambda)), std::string::npos);
        const SmoothingRun run =
            run_smoothing(study.subject, is_explicit ? SmoothingScheme::explicit_euler : SmoothingScheme::implicit_euler, lambda,
                          study.iterations.back(), study.iterations);
        const output::Panel* cells = &matrix.panels[r * width];
        for (std::size_t t = 0; t < study.iterations.size(); ++t) {
            if (t < run.snapshots.size() &&
                bounding_box(moved_to(mesh, run.snapshots[t])).diagonal() > 2 * bounding_box(study.subject.mesh()).diagonal()) {
                EXPECT_EQ(cells[1 + t].mesh, nullptr) << "a cut-out of spikes shows nothing";
                EXPECT_TRUE(cells[1 + t].label.ends_with("boxes wide")) << cells[1 + t].label;
            } else if (t < run.snapshots.size() &&
                       bounding_box(moved_to(mesh, run.snapshots[t])).diagonal() < 0.02 * study.subject.diagonal) {
                EXPECT_EQ(cells[1 + t].mesh, nullptr);
                EXPECT_EQ(cells[1 + t].label, "shrunk to a dot");
            } else if (t < run.snapshots.size()) {
                ASSERT_NE(cells[1 + t].mesh, nullptr) << r << ' ' << t;
                EXPECT_EQ(cells[1 + t].mesh->X, run.snapshots[t]);
                EXPECT_EQ(cells[1 + t].values, curvature_colours(study.subject, run.snapshots[t])) << "coloured by what is smoothed";
            } else {
                EXPECT_EQ(cells[1 + t].mesh, nullptr);
                EXPECT_EQ(cells[1 + t].label, "blew up in iteration " + std::to_string(run.result.blow_up_iteration));
            }
        }
    }
}

TEST(Q6, FiguresHaveOneScaleAndTheirOwnClippedShares) {
    const Answer answer = chapter_of_id("q6").answer(library_of(ellipsoid_mesh(3, {1.5, 1, 0.8}), "scale6"), quick_settings(), no_progress);
    const output::FigureRequest &matrix = figure_named(answer, "q6_scale6_matrix"), &views = figure_named(answer, "q6_views");
    EXPECT_EQ(matrix.range->high, views.range->high);
    EXPECT_EQ(matrix.range->low, views.range->low);
    EXPECT_TRUE(matrix.range->quantity.empty() && !views.range->quantity.empty()) << "one colour bar for all";
    double above = 0, all = 0;
    for (const double H : views.panels[0].values)
        if (std::isfinite(H)) ++all, above += H > views.range->high ? 1 : 0;
    EXPECT_EQ(views.range->clipped_above, above / all);
    QuestionSettings huge = quick_settings();
    huge.lambda = {1e6};
    const Answer gone = chapter_of_id("q6").answer(library_of(cube_mesh(5), "gone6"), huge, no_progress);
    EXPECT_FALSE(figure_named(gone, "q6_gone6_matrix").range->quantity.empty()) << "nothing is recommended: no other figure has it";
}

TEST(Q6, TheGapPlotIsTheGapOfTheCells) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "gaps6"), quick_settings());
    const report::Plot plot = gap_plot({study});
    ASSERT_EQ(plot.series.size(), 1u);
    ASSERT_EQ(plot.series[0].x.size(), study.iterations.size());
    for (std::size_t t = 0; t < study.iterations.size(); ++t) {
        const SmoothingCell& cell = study.cell(0, t);   // 0.5 λ_crit, the largest within the limit
        EXPECT_EQ(plot.series[0].x[t], cell.iterations);
        EXPECT_NEAR(plot.series[0].y[t],
                    100 * vertex_rms(cell.implicit_X, cell.explicit_X) / vertex_rms(study.subject.mesh().X, cell.implicit_X), 1e-9);
    }
    QuestionSettings beyond = quick_settings();
    beyond.lambda = {10 * study.subject.critical};
    EXPECT_TRUE(gap_plot({implicit_study(library_mesh(mesh, "gaps6"), beyond)}).series.empty()) << "no step within the limit";
    EXPECT_TRUE(gap_plot(Studies(6, study)).series.front().panel != "") << "no more than five curves together";
}

TEST(Q6, WhatIsRecommendedIsSeenFromAllSides) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "views6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "views6"), quick_settings());
    const output::FigureRequest& views = figure_named(answer, "q6_views");
    EXPECT_EQ(views.layout, output::Layout::six_views);
    ASSERT_EQ(views.panels.size(), 1u);
    const double diagonal = bounding_box(mesh).diagonal();
    EXPECT_LE((views.panels[0].mesh->X * diagonal - study.good()->implicit_X).norm(), 1e-12 * mesh.X.norm()) << "about the origin as it is";
    const Vector curvature = curvature_colours(study.subject, study.good()->implicit_X);
    ASSERT_EQ(views.panels[0].values.size(), curvature.size());
    EXPECT_EQ(views.panels[0].values, curvature) << "coloured by what is smoothed";
    EXPECT_NE(prose_of(answer.section).find("Recommended, implicit: " + title_of(study, *study.good())), std::string::npos);
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

}   // namespace meshfolio::q6_implicit
