#include <algorithm>

#include "base/number_text.h"
#include "questions/bench/curvature_study.h"
#include "questions/core/table.h"
#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

/// An estimator of H or of K, by its place in estimators_of.
struct Row {
    Quantity quantity;
    std::size_t estimator;
    std::string name() const { return estimators_of(quantity)[estimator].name(); }
};

/// Those of H, then those of K.
std::vector<Row> all_estimators() {
    std::vector<Row> rows;
    for (const Quantity quantity : quantities)
        for (std::size_t e = 0; e < estimators_of(quantity).size(); ++e) rows.push_back({quantity, e});
    return rows;
}

/// Has the columns that name the estimators.
TableBuilder<std::vector<Row>> table_of_estimators(std::string id, std::string caption) {
    return table(std::move(id), std::move(caption), all_estimators())
        .column("of", [](auto& row) { return symbol(row.quantity); })
        .column("estimator", &Row::name);
}

/// A sign for every surface, and the largest of the errors.
std::string behaviour_on(const GroundTruth& truth, MeshKind kind, const Row& row) {
    std::string signs;
    double worst = 0;
    for (const PanelRun* run : runs_of(truth, kind)) {
        const Behaviour behaviour = behaviour_of(truth.order(*run, row.quantity, row.estimator));
        signs += behaviour == Behaviour::second ? "●" : behaviour == Behaviour::first ? "◐" : "○";
        worst = std::max(worst, run->finest(row.quantity, row.estimator).l2);
    }
    return signs + " (" + readable_percent(worst, 2) + ")";
}

/// Every level of every run, and an estimator there.
struct Measured {
    const PanelRun& run;
    Row row;
    std::size_t level;
    FittedOrder l2, linf;
    const EstimateError& error() const { return run.error(row.quantity, row.estimator, level); }
};

}   // namespace

report::Table overview(const GroundTruth& truth) {
    std::vector<std::string> surfaces;
    for (const PanelRun* run : runs_of(truth, MeshKind::regular)) surfaces.push_back(run->surface);
    auto behaviours = table_of_estimators("truth_overview", words.line("overview", "surfaces"_a = listed(surfaces)));
    for (const MeshKind kind : mesh_kinds)
        behaviours.column(std::string(name_of(kind)), [&](auto& row) { return behaviour_on(truth, kind, row); });
    return behaviours;
}

report::Table error_table(const GroundTruth& truth, MeshKind kind, const Norm& norm) {
    const std::string name(name_of(kind));
    auto errors = table_of_estimators("truth_errors_" + name + "_" + norm.key, words.line("errors", "norm"_a = norm.name, "kind"_a = name));
    for (const PanelRun* run : runs_of(truth, kind))
        errors.column(run->surface, {.unit = "%", .heat = report::Column::Heat{0.1, 30}},
                      [&](auto& row) { return cell_of(100 * (run->finest(row.quantity, row.estimator).*norm.of)); });
    return errors;
}

report::Table order_table(const GroundTruth& truth, MeshKind kind, const Norm& norm) {
    const std::string name(name_of(kind));
    auto orders = table_of_estimators(
        "truth_orders_" + name + "_" + norm.key,
        words.line("orders", "norm"_a = norm.name, "kind"_a = name, "refinements"_a = truth.runs.front().levels.size()));
    for (const PanelRun* run : runs_of(truth, kind))
        orders.column(run->surface, [&](auto& row) { return words_of(truth.order(*run, row.quantity, row.estimator, norm.of)); });
    return orders;
}

report::Plot convergence_plot(const GroundTruth& truth, MeshKind kind, Quantity quantity) {
    static const std::vector<std::string> shown{"uniform", "barycentric", "voronoi", "mixed", "jet", "corrected_max", "corrected_exact"};
    const PanelRun& run = truth.run("ellipsoid", kind);
    const std::string caption =
        words.line("convergence", "quantity"_a = symbol(quantity), "kind"_a = name_of(kind), "dimensions"_a = run.dimensions);
    report::Plot plot{.id = (quantity == Quantity::H ? "truth_h_" : "truth_k_") + std::string(name_of(kind)),
                      .caption = caption,
                      .alt = caption,
                      .x_label = "mean edge [length]",
                      .y_label = "relative L2 error [%]",
                      .log_x = true,
                      .log_y = true};
    for (std::size_t e = 0; e < estimators_of(quantity).size(); ++e) {
        const Estimator& estimator = estimators_of(quantity)[e];
        const auto place = std::ranges::find(shown, estimator.key);
        if (place == shown.end()) continue;
        ErrorHistory history;
        for (std::size_t level = 0; level < run.levels.size(); ++level) {
            history.mean_edges.push_back(run.levels[level].mean_edge);
            history.errors.push_back(run.error(quantity, e, level).l2);
        }
        using enum report::Series::Style;
        plot.series.push_back(error_series(estimator.name(), history, estimator.key == "corrected_exact" ? dashed : line_and_points));
        plot.series.back().color = plot.series.back().pattern = int(place - shown.begin());   // the same in the plots of H and of K
        plot.alt +=
            " " + words.line("convergence.alt.series", "estimator"_a = estimator.name(),
                             "error"_a = readable_percent(history.errors.back(), 2), "order"_a = words_of(truth.order(run, quantity, e)));
    }
    return plot;
}

report::Table ground_truth_table(const GroundTruth& truth) {
    std::vector<Measured> all;
    for (const PanelRun& run : truth.runs) {
        for (const Row& row : all_estimators()) {
            const FittedOrder l2 = truth.order(run, row.quantity, row.estimator);
            const FittedOrder linf = truth.order(run, row.quantity, row.estimator, &EstimateError::linf);
            for (std::size_t level = 0; level < run.levels.size(); ++level) all.push_back({run, row, level, l2, linf});
        }
    }
    return table("truth_all", "", all)
        .column("of", [](auto& m) { return symbol(m.row.quantity); })
        .column("estimator", [](auto& m) { return m.row.name(); })
        .column("surface", [](auto& m) { return m.run.surface; })
        .column("mesh", [](auto& m) { return name_of(m.run.kind); })
        .column("vertices", [](auto& m) { return m.run.levels[m.level].vertices; })
        .column("mean edge", {.unit = "length"}, [](auto& m) { return m.run.levels[m.level].mean_edge; })
        .column("L2 error", [](auto& m) { return m.error().l2; })
        .column("L∞ error", [](auto& m) { return m.error().linf; })
        .column("undefined", {.unit = "vertices"}, [](auto& m) { return m.error().undefined; })
        .column("order, L2", [](auto& m) { return cell_of(m.l2.order); })
        .column("standard error, L2", [](auto& m) { return cell_of(m.l2.standard_error); })
        .column("order, L∞", [](auto& m) { return cell_of(m.linf.order); })
        .column("standard error, L∞", [](auto& m) { return cell_of(m.linf.standard_error); });
}

}   // namespace meshfolio::truth
