#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

/// Returns the estimators of H, then those of K.
std::vector<const Estimator*> rows() {
    std::vector<const Estimator*> rows = panel_estimators(Quantity::H);
    std::ranges::copy(panel_estimators(Quantity::K), std::back_inserter(rows));
    return rows;
}

/// Returns a table of all estimators, with the columns of their names.
TableBuilder<std::vector<const Estimator*>> table_of_estimators(std::string id, std::string caption) {
    return table(std::move(id), std::move(caption), rows())
        .column("of", [](auto* e) { return symbol(e->quantity); })
        .column("estimator", &Estimator::name);
}

/// Returns "●" for second order or exact, "◐" for less, "○" for no convergence, "–" for too few levels.
std::string sign_of(const Order& order) {
    if (std::isnan(order.exponent) && !order.exact) return "–";
    return !order.converges() ? "○" : order.exponent < 1.5 ? "◐" : "●";
}

}   // namespace

report::Table overview(const GroundTruth& truth) {
    const std::string surfaces = listed(each_of(of_kind(truth.runs, MeshKind::regular), &BenchRun::surface));
    auto behaviours = table_of_estimators("truth_overview", words.line("overview", "surfaces"_a = surfaces));
    for (const MeshKind kind : panel_kinds) {
        behaviours.column(std::string(name_of(kind)), [&](auto* e) {
            std::string signs;
            double worst = 0;
            for (const BenchRun& run : of_kind(truth.runs, kind)) {
                const ErrorHistory errors = run.errors(e->key);
                signs += sign_of(errors.order());
                worst = std::max(worst, errors.last());
            }
            return signs + " (" + readable_percent(worst, 2) + ")";
        });
    }
    return behaviours;
}

report::Table error_table(const GroundTruth& truth, MeshKind kind) {
    const std::string name(name_of(kind));
    auto errors = table_of_estimators("truth_errors_" + name + "_l2", words.line("errors", "kind"_a = name));
    for (const BenchRun& run : of_kind(truth.runs, kind))
        errors.column(run.surface, {.unit = "%", .heat = Heat{0.1, 30}},
                      [&](auto* e) { return cell_of(100 * run.finest().error(e->key).l2); });
    return errors;
}

report::Plot convergence_plot(const GroundTruth& truth, MeshKind kind, Quantity quantity) {
    static const Names shown{"uniform", "barycentric", "voronoi", "mixed", "jet", "corrected_max", "corrected_exact"};
    const BenchRun& run = truth.run("ellipsoid", kind);
    const std::string caption = words.line("convergence", "quantity"_a = symbol(quantity), "kind"_a = name_of(kind));
    report::Plot plot = error_plot((quantity == Quantity::H ? "truth_h_" : "truth_k_") + std::string(name_of(kind)), caption, caption);
    for (const Estimator* e : panel_estimators(quantity)) {
        const auto place = std::ranges::find(shown, e->key.substr(2));   // without "H."
        if (place == shown.end()) continue;
        using enum report::Series::Style;
        const ErrorHistory errors = run.errors(e->key);
        plot.series.push_back(error_series(e->name(), errors, *place == "corrected_exact" ? dashed : line_and_points));
        plot.series.back().color = plot.series.back().pattern = int(place - shown.begin());   // alike in the plots of H and of K
        plot.series.back().panel = words.line(place - shown.begin() < 4 ? "convergence.operators" : "convergence.fits");
        plot.alt += " " + words.line("convergence.alt.series", "estimator"_a = e->name(), "error"_a = readable_percent(errors.last(), 2),
                                     "order"_a = words_of(errors.order()));
    }
    return plot;
}

report::Table finest_table(const GroundTruth& truth) {
    struct Row {
        const BenchRun& run;
        const Estimator& estimator;
        Order order;
    };
    std::vector<Row> all;
    for (const BenchRun& run : truth.runs)
        for (const Estimator* e : rows()) all.push_back({run, *e, run.errors(e->key).order()});
    return table("truth_finest", "", all)
        .column("of", [](auto& row) { return symbol(row.estimator.quantity); })
        .column("estimator", [](auto& row) { return row.estimator.name(); })
        .column("surface", [](auto& row) { return row.run.surface; })
        .column("mesh", [](auto& row) { return name_of(row.run.kind); })
        .column("L2 error", [](auto& row) { return row.run.finest().error(row.estimator.key).l2; })
        .column("order", [](auto& row) { return cell_of(row.order.exponent); })
        .column("margin", [](auto& row) { return cell_of(row.order.margin); })
        .file_only();
}

report::Table ground_truth_table(const GroundTruth& truth) {
    struct Measured {
        const BenchRun& run;
        const Estimator& estimator;
        const BenchLevel& level;
        Order l2, linf;
        const EstimateError& error() const { return level.error(estimator.key); }
    };
    std::vector<Measured> all;
    for (const BenchRun& run : truth.runs) {
        for (const Estimator* e : rows()) {
            const Order l2 = run.errors(e->key).order(), linf = run.errors(e->key, &EstimateError::linf).order();
            for (const BenchLevel& level : run.levels) all.push_back({run, *e, level, l2, linf});
        }
    }
    return table("truth_all", "", all)
        .column("of", [](auto& m) { return symbol(m.estimator.quantity); })
        .column("estimator", [](auto& m) { return m.estimator.name(); })
        .column("surface", [](auto& m) { return m.run.surface; })
        .column("mesh", [](auto& m) { return name_of(m.run.kind); })
        .column("vertices", [](auto& m) { return m.level.vertices; })
        .column("mean edge", {.unit = "length"}, [](auto& m) { return m.level.mean_edge; })
        .column("L2 error", [](auto& m) { return m.error().l2; })
        .column("L∞ error", [](auto& m) { return m.error().linf; })
        .column("undefined", {.unit = "vertices"}, [](auto& m) { return m.error().undefined; })
        .column("order, L2", [](auto& m) { return cell_of(m.l2.exponent); })
        .column("margin, L2", [](auto& m) { return cell_of(m.l2.margin); })
        .column("order, L∞", [](auto& m) { return cell_of(m.linf.exponent); })
        .column("margin, L∞", [](auto& m) { return cell_of(m.linf.margin); })
        .file_only();
}

}   // namespace meshfolio::truth
