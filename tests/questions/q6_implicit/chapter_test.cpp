#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/q6_implicit/parts.h"
#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {
using namespace testing_tools;

TEST(Q6, HugeStepsStayStable) {
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
    const report::Table& table = table_named(answer.section, "q6_grid");
    const double percent = 100 / bounding_box(mesh).diagonal();
    std::vector<double> tau, iterations, energy, moved, size;
    for (const SmoothingCell& cell : study.grid) {
        tau.push_back(cell.lambda / study.subject.critical);
        iterations.push_back(cell.iterations);
        energy.push_back(100 * cell.implicit_energy);
        moved.push_back(percent * vertex_rms(study.subject.mesh().X, cell.implicit_X));
        size.push_back(100 * cell.kept);
    }
    expect_near(numbers(table, "λ/λ_crit"), tau);
    expect_near(numbers(table, "t"), iterations);
    expect_near(numbers(table, "energy, implicit"), energy);
    expect_near(numbers(table, "moved, implicit"), moved, 1e-6);
    expect_near(numbers(table, "size, implicit"), size);
    const std::vector<report::Cell> gap = cells(table, "gap"), explicit_energy = cells(table, "explicit");
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

TEST(Q6, EachColumnComparesTwoVisibleStates) {
    for (const TriangleMesh& mesh : {ellipsoid_mesh(3, {1.5, 1, 0.8}), cube_mesh(1)}) {
        SCOPED_TRACE(mesh.vertex_count());
        const std::string name = "pairs6_" + std::to_string(mesh.vertex_count());
        const Answer answer = chapter_of_id("q6").answer(library_of(mesh, name), quick_settings(), no_progress);
        const ImplicitStudy study = implicit_study(library_mesh(mesh, name), quick_settings());
        const output::FigureRequest& pairs = figure_named(answer, "q6_" + name + "_pairs");
        const auto width = static_cast<std::size_t>(pairs.in_a_line);
        EXPECT_EQ(pairs.layout, output::Layout::one_frame);
        ASSERT_EQ(pairs.panels.size(), 2 * width) << "no empty cell";
        EXPECT_EQ(pairs.panels[0].mesh->X, study.subject.mesh().X);
        int inputs = 0;
        for (const output::Panel& panel : pairs.panels) {
            ASSERT_NE(panel.mesh, nullptr);
            inputs += panel.label == "input" ? 1 : 0;
            const double size = bounding_box(*panel.mesh).diagonal() / study.subject.diagonal;
            EXPECT_TRUE(0.02 <= size && size <= 2) << panel.label;
            EXPECT_EQ(panel.values, curvature_colours(study.subject, panel.mesh->X)) << "coloured by what is smoothed";
        }
        EXPECT_EQ(inputs, 1);
        if (study.good()) {
            EXPECT_EQ(pairs.panels[width].mesh->X, study.good()->implicit_X);
        }
        for (std::size_t c = 1; c < width; ++c) {
            const std::string above = pairs.panels[c].label, below = pairs.panels[width + c].label;
            EXPECT_TRUE(below.starts_with("implicit, ")) << below;
            if (above.starts_with("explicit, ")) {
                EXPECT_EQ(above.substr(10), below.substr(10)) << "equal λ and t";
            }
        }
    }
}

TEST(Q6, EveryFigureHasAColourBarAndItsOwnClippedShares) {
    const Answer answer = chapter_of_id("q6").answer(library_of(ellipsoid_mesh(3, {1.5, 1, 0.8}), "scale6"), quick_settings(), no_progress);
    const output::FigureRequest &pairs = figure_named(answer, "q6_scale6_pairs"), &views = figure_named(answer, "q6_views");
    EXPECT_EQ(pairs.range->high, views.range->high);
    EXPECT_EQ(pairs.range->low, views.range->low);
    for (const output::FigureRequest& figure : answer.figures) EXPECT_FALSE(figure.range->quantity.empty()) << figure.id;
    double above = 0, all = 0;
    for (const double H : views.panels[0].values)
        if (std::isfinite(H)) ++all, above += H > views.range->high ? 1 : 0;
    EXPECT_EQ(views.range->clipped_above, above / all);
}

TEST(Q6, TheMapOfTheGapIsInPercentOfTheMotion) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q6").answer(library_of(mesh, "map6"), quick_settings(), no_progress);
    const ImplicitStudy study = implicit_study(library_mesh(mesh, "map6"), quick_settings());
    const output::FigureRequest& map = figure_named(answer, "q6_gap_map");
    ASSERT_TRUE(study.cost);
    ASSERT_EQ(map.panels.size(), 1u);
    const double motion = vertex_rms(study.subject.mesh().X, study.good()->implicit_X);
    EXPECT_LE((map.panels[0].values - 100 / motion * study.cost->gap).norm(), 1e-9 * map.panels[0].values.norm());
    EXPECT_EQ(map.range->unit, "% of the motion");
}

TEST(Q6, TheGapPlotShowsTheGapsOfTheCells) {
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

TEST(Q6, TheRecommendedResultIsShownFromSixDirections) {
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
    const std::string recommended = "Recommended: " + std::to_string(study.good()->iterations) + " implicit step";
    EXPECT_NE(prose_of(answer.section).find(recommended), std::string::npos) << prose_of(answer.section);
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
