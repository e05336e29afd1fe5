// The section "Ground truth" of the report: tables, plots and their discussion.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/bench/curvature_study.h"
#include "questions/core/section_tools.h"
#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

using report::Cell;
using report::math;
using report::ref;

constexpr std::array quantities{Quantity::H, Quantity::K};

std::vector<const PanelRun*> runs_of(const GroundTruth& truth, MeshKind kind) {
    std::vector<const PanelRun*> runs;
    for (const PanelRun& run : truth.runs) {
        if (run.kind == kind) runs.push_back(&run);
    }
    return runs;
}

/// row(quantity, estimator) for every estimator of H, then of K.
template <class Row>
void for_each_estimator(Row row) {
    for (const Quantity quantity : quantities) {
        for (std::size_t e = 0; e < estimators_of(quantity).size(); ++e) row(quantity, e);
    }
}

std::vector<Cell> row_of(Quantity quantity, std::size_t estimator) { return {symbol(quantity), estimators_of(quantity)[estimator].name()}; }

// ---- how an error behaves ---------------------------------------------------------------------------------------------

enum class Behaviour { second, first, none };

Behaviour behaviour_of(const FittedOrder& order) {
    if (std::isnan(order.order) || order.order >= 1.5) return Behaviour::second;   // without an order: exact
    return order.order >= 0.5 ? Behaviour::first : Behaviour::none;
}

const char* sign_of(Behaviour behaviour) { return behaviour == Behaviour::second ? "●" : behaviour == Behaviour::first ? "◐" : "○"; }

report::Table overview(const GroundTruth& truth) {
    report::Table table;
    table.id = "truth_overview";
    std::vector<std::string> surfaces;
    for (const PanelRun* run : runs_of(truth, MeshKind::regular)) surfaces.push_back(run->surface);
    table.caption = "How the L2 error behaves as the edges shrink, one sign a surface (" + listed(surfaces) +
                    "): ● second order (fitted order ≥ 1.5) or exact, ◐ converging (≥ 0.5), ○ not converging. In brackets the largest of "
                    "the errors on the finest meshes.";
    table.columns = {{"of"}, {"estimator"}};
    for (const MeshKind kind : mesh_kinds) table.columns.push_back({std::string(name_of(kind))});
    for_each_estimator([&](Quantity quantity, std::size_t e) {
        std::vector<Cell> row = row_of(quantity, e);
        for (const MeshKind kind : mesh_kinds) {
            std::string cell;
            double worst = 0;
            for (const PanelRun* run : runs_of(truth, kind)) {
                cell += sign_of(behaviour_of(truth.order(*run, quantity, e)));
                worst = std::max(worst, run->finest(quantity, e).l2);
            }
            row.emplace_back(cell + " (" + readable_percent(worst, 2) + ")");
        }
        table.rows.push_back(std::move(row));
    });
    return table;
}

struct Norm {
    double EstimateError::*of;
    std::string key, name;
};
const std::array<Norm, 2>& norms() {
    static const std::array<Norm, 2> list{{{&EstimateError::l2, "l2", "L2"}, {&EstimateError::linf, "linf", "L∞"}}};
    return list;
}

/// One row an estimator, one column a surface: what `cell` says of each.
template <class CellOf>
void fill(report::Table& table, const GroundTruth& truth, MeshKind kind, const report::Column& column, CellOf cell) {
    table.columns = {{"of"}, {"estimator"}};
    const auto runs = runs_of(truth, kind);
    for (const PanelRun* run : runs) {
        table.columns.push_back(column);
        table.columns.back().name = run->surface;
    }
    for_each_estimator([&](Quantity quantity, std::size_t e) {
        std::vector<Cell> row = row_of(quantity, e);
        for (const PanelRun* run : runs) row.push_back(cell(*run, quantity, e));
        table.rows.push_back(std::move(row));
    });
}

report::Table error_table(const GroundTruth& truth, MeshKind kind, const Norm& norm) {
    const std::string name(name_of(kind));
    report::Table table;
    table.id = "truth_errors_" + name + "_" + norm.key;
    table.caption =
        "Relative " + norm.name + " errors on the finest " + name + " meshes, shaded from 0.1 % to 30 % on a logarithmic scale.";
    report::Column percent{"", "%", 3};
    percent.heat = {0.1, 30};
    fill(table, truth, kind, percent,
         [&](const PanelRun& run, Quantity quantity, std::size_t e) { return cell_of(100 * (run.finest(quantity, e).*norm.of)); });
    return table;
}

report::Table order_table(const GroundTruth& truth, MeshKind kind, const Norm& norm) {
    const std::string name(name_of(kind));
    report::Table table;
    table.id = "truth_orders_" + name + "_" + norm.key;
    table.caption = "Order p of " + norm.name + " error ≈ c·hᵖ on " + name + " meshes with its standard error, fitted over " +
                    counted(static_cast<int>(truth.runs.front().levels.size()), "refinement") + "; exact: the error is rounding.";
    fill(table, truth, kind, {},
         [&](const PanelRun& run, Quantity quantity, std::size_t e) { return words_of(truth.order(run, quantity, e, norm.of)); });
    return table;
}

// ---- plots ------------------------------------------------------------------------------------------------------------

report::Plot convergence_plot(const GroundTruth& truth, MeshKind kind, Quantity quantity) {
    static const std::vector<std::string> shown{"uniform", "barycentric", "voronoi", "mixed", "jet", "corrected_max", "corrected_exact"};
    const PanelRun& run = truth.run("ellipsoid", kind);
    const std::string name(name_of(kind));
    report::Plot plot;
    plot.id = "truth_" + std::string(quantity == Quantity::H ? "h_" : "k_") + name;
    plot.caption = "L2 error of " + symbol(quantity) + " over the mean edge on the " + name + " ellipsoid (" + run.dimensions + ").";
    plot.alt = plot.caption;
    plot.x_label = "mean edge [length]";
    plot.y_label = "relative L2 error [%]";
    plot.log_x = plot.log_y = true;
    for (std::size_t e = 0; e < estimators_of(quantity).size(); ++e) {
        const Estimator& estimator = estimators_of(quantity)[e];
        const auto place = std::find(shown.begin(), shown.end(), estimator.key);
        if (place == shown.end()) continue;
        ErrorHistory history;
        for (std::size_t level = 0; level < run.levels.size(); ++level) {
            history.mean_edges.push_back(run.levels[level].mean_edge);
            history.errors.push_back(run.error(quantity, e, level).l2);
        }
        const bool given_normals = estimator.key == "corrected_exact";
        plot.series.push_back(
            error_series(estimator.name(), history, given_normals ? report::Series::Style::dashed : report::Series::Style::line_and_points));
        plot.series.back().color = plot.series.back().pattern = int(place - shown.begin());   // the same in the plots of H and of K
        plot.alt += " " + estimator.name() + ": " + readable_percent(history.errors.back(), 2) + " at the finest, order " +
                    words_of(truth.order(run, quantity, e)) + ".";
    }
    return plot;
}

// ---- words ------------------------------------------------------------------------------------------------------------

/// "27.6 % (order 0.03 ± 0.01)".
std::string told(const GroundTruth& truth, const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key) {
    return readable_percent(truth.finest(surface, kind, quantity, key).l2, 2) + " (order " +
           words_of(truth.order(surface, kind, quantity, key)) + ")";
}

void add_method(report::Section& section, const GroundTruth& truth) {
    add_heading(section, "Method");
    std::vector<std::string> surfaces;
    for (const PanelRun* run : runs_of(truth, MeshKind::regular)) surfaces.push_back(run->surface + " (" + run->dimensions + ")");
    add_paragraph(
        section, "Every estimator runs on every surface with a closed form: ", listed(surfaces), "; each as ",
        counted(static_cast<int>(truth.runs.front().levels.size()), "refinement"), " of up to ",
        std::to_string(truth.run("saddle", MeshKind::regular).levels.back().vertices),
        " vertices of four kinds. Regular: each refinement halves the edges. Random: hulls of independent points on the sphere and "
        "the ellipsoid, elsewhere points that wandered over the surface, with edges flipped to Delaunay. Noisy: regular, moved "
        "along the normal by 1 % of the mean edge. Anisotropic: triangles stretched about four to one.");
    add_formula(section, "relative_l2_error", "truth_eq_l2");
    add_formula(section, "convergence_order", "truth_eq_order");
    add_paragraph(section, "Where the truth vanishes everywhere (H of the catenoid, K of the cylinder), errors are relative to ",
                  math("√(2H² − K)"), " and ", math("2H² − K"),
                  " instead. Less than three edges of the coarsest mesh from a boundary nothing is measured, by any estimator. Jets are "
                  "polynomials of degree 3 "
                  "fitted to two rings ",
                  ref("cazals_pouget_2005"), "; corrected curvature integrates interpolated normals ", ref("lachaud_2020"),
                  ", which are area-weighted, angle-weighted, weighted after Max ", ref("max_1999"),
                  ", or those of the surface. The lengths ½‖Δx‖ of the uniform operator are made curvatures by 4/h², as in question 1.");
}

bool converges(const GroundTruth& truth, const PanelRun& run, const char* key_of_H) {
    return behaviour_of(truth.order(run, Quantity::H, estimator_index(Quantity::H, key_of_H))) != Behaviour::none;
}

/// On which surfaces H from the cotangent formula converges on random points, one kind of area after the other.
std::string random_words(const GroundTruth& truth) {
    std::vector<std::string> told;
    for (const auto& [key, areas] : {std::pair{"barycentric", "barycentric"}, {"voronoi", "Voronoi"}, {"mixed", "mixed"}}) {
        std::vector<std::string> surfaces;
        for (const PanelRun* run : runs_of(truth, MeshKind::random)) {
            if (converges(truth, *run, key)) surfaces.push_back(run->surface);
        }
        told.push_back("with " + std::string(areas) + " areas on " + (surfaces.empty() ? "no surface" : "the " + listed(surfaces)));
    }
    return "On random points H from the cotangent formula converges (order at least 0.5) " + listed(told) + ".";
}

/// On how many noiseless runs the jet converges.
std::string jet_words(const GroundTruth& truth) {
    int converging = 0, runs = 0;
    for (const PanelRun& run : truth.runs) {
        if (run.kind == MeshKind::noisy) continue;
        ++runs;
        converging += converges(truth, run, "jet") ? 1 : 0;
    }
    return "Without noise H from the jet converges (order at least 0.5) on " + std::to_string(converging) + " of " +
           counted(runs, "sequence") + " of meshes:";
}

void add_discussion(report::Section& section, const GroundTruth& truth) {
    add_heading(section, "Discussion");
    const auto tell = [&](const char* surface, MeshKind kind, const char* key, Quantity quantity = Quantity::H) {
        return told(truth, surface, kind, quantity, key);
    };
    const MeshKind regular = MeshKind::regular, random = MeshKind::random, noisy = MeshKind::noisy;
    add_paragraph(section, "On regular triangles the cotangent formula is a good approximation: H on the torus has an L2 error of ",
                  tell("torus", regular, "mixed"), " with mixed areas, K from the angle deficit ",
                  tell("torus", regular, "mixed", Quantity::K), ". The uniform operator is off by ", tell("torus", regular, "uniform"),
                  " there even when its length is scaled: it takes the parametrisation for the surface.");
    add_paragraph(
        section, "Regular must be meant literally. On the stretched icosphere H with mixed areas has ", tell("ellipsoid", regular, "mixed"),
        ", and its L∞ error is still ", readable_percent(truth.finest("ellipsoid", regular, Quantity::H, "mixed").linf, 2), " (order ",
        words_of(truth.order(truth.run("ellipsoid", regular), Quantity::H, estimator_index(Quantity::H, "mixed"), &EstimateError::linf)),
        "), for rings at old vertices never become symmetric; on a grid over the same ellipsoid it is ",
        tell("ellipsoid band", regular, "mixed"), ". With barycentric areas the icosphere itself keeps ",
        readable_percent(truth.finest("sphere", regular, Quantity::H, "barycentric").linf, 3), " at its twelve vertices of valence 5.");
    add_paragraph(section, random_words(truth), " H on the ellipsoid: barycentric ", tell("ellipsoid", random, "barycentric"), ", mixed ",
                  tell("ellipsoid", random, "mixed"), "; taking ", math("−½Δx · n"), " with the exact normal in place of ", math("½‖Δx‖"),
                  " gives ", tell("ellipsoid", random, "mixed_n"), ", K from the angle deficit with mixed areas ",
                  tell("ellipsoid", random, "mixed", Quantity::K), ". The operator converges weakly, as an integral, not at points ",
                  ref("wardetzky_2008"), ", ", ref("borrelli_2003"), ".");
    add_paragraph(
        section, jet_words(truth), " H on the random ellipsoid ", tell("ellipsoid", random, "jet"), ", K ",
        tell("ellipsoid", random, "jet", Quantity::K), ". Corrected curvature is as good as its normals: on the same mesh exact ones give ",
        tell("ellipsoid", random, "corrected_exact"), ", those of Max ", tell("ellipsoid", random, "corrected_max"), ", angle-weighted ",
        tell("ellipsoid", random, "corrected_angle"), ", area-weighted ", tell("ellipsoid", random, "corrected_area"), ".");
    add_paragraph(
        section,
        "Noise in proportion to the edges spoils second derivatives as the edges shrink: with 1 % of an edge H on the ellipsoid is off by ",
        tell("ellipsoid", noisy, "mixed"), " by cotangents and ", tell("ellipsoid", noisy, "jet"),
        " by jets, which average over two rings.");
}

void add_findings(report::Section& section, const GroundTruth& truth) {
    const PanelRun& run = truth.run("ellipsoid", MeshKind::random);
    const auto does = [&](const char* key) { return converges(truth, run, key) ? "converges" : "does not converge"; };
    section.findings.push_back(
        {report::text("On a random mesh of the ellipsoid cotangent H with mixed areas ", does("mixed"), ": its L2 error is ",
                      told(truth, run.surface, run.kind, Quantity::H, "mixed"), "; the degree-3 jet ", does("jet"), ": ",
                      told(truth, run.surface, run.kind, Quantity::H, "jet"), "."),
         79});
}

}   // namespace

report::Section ground_truth_section(const GroundTruth& truth) {
    report::Section section = section_of("truth");
    section.extent = std::to_string(estimators_of(Quantity::H).size()) + " estimators of H and " +
                     std::to_string(estimators_of(Quantity::K).size()) + " of K on " +
                     std::to_string(runs_of(truth, MeshKind::regular).size()) + " surfaces in " + std::to_string(mesh_kinds.size()) +
                     " kinds of mesh";
    section.parameters = {{"seed", std::to_string(truth.seed)}, {"refinements", std::to_string(truth.runs.front().levels.size())}};
    add_method(section, truth);
    add_heading(section, "Results");
    section.blocks.emplace_back(overview(truth));
    for (const MeshKind kind : mesh_kinds) {
        for (const Quantity quantity : quantities) section.blocks.emplace_back(convergence_plot(truth, kind, quantity));
        for (const Norm& norm : norms()) {
            section.blocks.emplace_back(error_table(truth, kind, norm));
            section.blocks.emplace_back(order_table(truth, kind, norm));
        }
    }
    add_discussion(section, truth);
    append_checks(section, ground_truth_checks(truth));
    add_findings(section, truth);
    return section;
}

Answer answer(const MeshLibrary&, const QuestionSettings& settings, const Progress& progress) {
    return {ground_truth_section(*shared_ground_truth(settings, progress)), {}, {}};
}

extern const Chapter chapter{
    .id = "truth",
    .code = {{"jet_curvature", "src/geometry/curvature/jet_fit.cpp"},
             {"corrected_curvature", "src/geometry/curvature/corrected_curvature.cpp"},
             {"truth_mesh", "src/questions/bench/ground_truth_meshes.cpp"},
             {"panel_level", "src/questions/bench/ground_truth.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::truth
