#include "questions/prediction/parts.h"

namespace meshfolio::prediction {

namespace {

using Style = report::Series::Style;

/// One operator at one level of noise on one mesh.
struct Row {
    const PredictionStudy& study;
    const NoiseLevelStudy& level;
    const OperatorStudy& own;

    int steps() const { return own.measured.iterations(); }
};

/// A table with a row for each of these operators at each level; every one begins with mesh and noise.
auto begun_table(std::string id, std::string caption, const Studies& studies, std::initializer_list<FlowOperator> kinds) {
    std::vector<Row> rows;
    for (const auto& [study, level] : levels_of(studies))
        for (const FlowOperator kind : kinds) rows.push_back({study, level, level.of(kind)});
    auto begun = table(std::move(id), std::move(caption), std::move(rows));
    begun.column("mesh", [](auto& r) { return r.study.name(); })
        .column("σ", {.unit = "% of box"}, [](auto& r) { return 100 * r.level.sigma; })
        .column("σ", {.unit = "mean edges"}, [](auto& r) { return r.level.sigma_edges; });
    return begun;
}

/// "23", or "40, still falling" at the end of the run.
std::string best_words(int best, int iterations) {
    return std::to_string(best) + (best < iterations || best == 0 ? "" : ", still falling");
}
std::string measured_best(const Row& r) { return best_words(r.own.measured.best(), r.steps()); }
std::string formula_best(const Row& r) { return best_words(r.own.formula().best(), r.steps()); }

/// A cell made from the prediction or the rule of a name; empty where there is none.
template <class Entry>
auto cell_from(const Entry* (OperatorStudy::*find)(std::string_view) const, std::string_view name, auto cell) {
    return [=](const Row& r) {
        const Entry* entry = (r.own.*find)(name);
        return entry == nullptr ? report::Cell() : cell(r, *entry);
    };
}

/// Shows the best iteration of a prediction and its largest deviation.
auto best_of(std::string_view name) {
    return cell_from(&OperatorStudy::prediction, name,
                     [](const Row& r, const PredictedCurve& p) -> report::Cell { return best_words(p.best(), r.steps()); });
}
auto deviation_of(std::string_view name) {
    return cell_from(&OperatorStudy::prediction, name, [](const Row& r, const PredictedCurve& p) -> report::Cell {
        const double off = deviation(p, r.own.measured);
        return off > deviation_shown ? report::Cell("> " + plain_text(100 * deviation_shown)) : report::Cell(100 * off);
    });
}

/// Shows what a rule chose, and what that cost where the minimum is known.
auto chosen_by(std::string_view name) {
    return cell_from(&OperatorStudy::rule, name, [](const Row&, const RuleOutcome& rule) -> report::Cell { return rule.mean_chosen(); });
}
auto regret_of(std::string_view name, double (RuleOutcome::*regret)() const = &RuleOutcome::mean_regret) {
    return cell_from(&OperatorStudy::rule, name,
                     [=](const Row& r, const RuleOutcome& rule) { return cell_of(100 * (rule.*regret)(), r.own.minimum_reached()); });
}

/// "on cube from all 602 modes, on lily from 18 probes"
std::string how_predicted(const Studies& studies) {
    Names told;
    for (const PredictionStudy& study : studies) {
        const DenoisingPrediction& p = study.prediction;
        told.push_back(
            words.line(p.modes > 0 ? "clean.modes" : "clean.probes", "mesh"_a = study.name(), "modes"_a = p.modes, "probes"_a = p.probes));
    }
    return joined(told, ", ");
}

std::string collapsed_runs(const Studies& studies) {
    int collapsed = 0;
    for (const auto& [study, level] : levels_of(studies))
        for (const OperatorStudy& operated : level.operators) collapsed += operated.collapsed;
    return collapsed == 0 ? words.line("operators.none_collapsed") : words.line("operators.collapsed", "runs"_a = collapsed);
}

/// √ of the values in % of the box; a negative estimate leaves a gap, and so does what lies beyond `most`.
report::Series root_series(std::string name, const Vector& square, Style style, double most = infinity) {
    report::Series series{.name = std::move(name), .style = style};
    for (Eigen::Index t = 0; t < square.size(); ++t)
        add_point(series, double(t), square[t] >= 0 && square[t] <= most ? 100 * std::sqrt(square[t]) : undefined);
    return series;
}

report::Series measured_series(std::string name, const MeasuredCurve& measured) {
    report::Series series = root_series(std::move(name), measured.square, Style::line);
    for (Eigen::Index t = 0; t < measured.square.size(); ++t) {
        series.y_low.push_back(100 * measured.low[t]);
        series.y_high.push_back(100 * measured.high[t]);
    }
    return series;
}

/// "measured t = 7"; an error that is smallest at its end has no minimum yet.
report::Marker marker_at(const Vector& square, int t, std::string label) {
    if (t > 0 && t + 1 == square.size()) label = "still falling, t = ";
    return {static_cast<double>(t), 100 * std::sqrt(std::max(square[t], 0.0)), label + std::to_string(t)};
}

report::Plot error_plot(const PredictionStudy& study, const std::string& what) {
    return {.id = id_of("prediction", study.name(), what), .x_label = "iteration", .y_label = words.line("plot.y"), .log_y = true};
}

}   // namespace

report::Table clean_prediction_table(const Studies& studies) {
    return begun_table("prediction_clean", words.line("clean", "seeds"_a = studies.front().seeds, "how"_a = how_predicted(studies)),
                       studies, {FlowOperator::clean})
        .column("best iteration, expected", formula_best)
        .column("best iteration, measured", measured_best)
        .column("by area, expected",
                [](auto& r) { return best_words(std::min(r.study.prediction.mass.best(r.level.sigma), r.steps()), r.steps()); })
        .column("by area, measured", [](auto& r) { return best_words(first_smallest(r.own.measured.mass), r.steps()); })
        .column("error, expected", {.unit = "% of box", .digits = 4},
                [](auto& r) { return 100 * std::sqrt(r.own.formula().square[r.own.measured.best()]); })
        .column("error, measured", {.unit = "% of box", .digits = 4},
                [](auto& r) { return 100 * std::sqrt(r.own.measured.square[r.own.measured.best()]); })
        .column("farthest, vertices", {.unit = "%", .digits = 2}, [](auto& r) { return 100 * deviation(r.own.formula(), r.own.measured); })
        .column("farthest, area", {.unit = "%", .digits = 2}, [](auto& r) { return 100 * largest_mass_deviation(r.study, r.level); })
        .column("farthest", {.unit = "std. errors", .digits = 2}, [](auto& r) { return standard_distance(r.study, r.level).larger(); })
        .column("regret", {.unit = "%", .digits = 2}, [](auto& r) { return 100 * r.own.regret_of_formula; });
}

report::Table operator_prediction_table(const Studies& studies) {
    const PredictionStudy& first = studies.front();
    return begun_table("prediction_operators",
                       words.line("operators", "seeds"_a = first.seeds, "draws"_a = first.draws, "probes"_a = first.derivative_probes,
                                  "collapsed"_a = collapsed_runs(studies)),
                       studies, {FlowOperator::noisy, FlowOperator::rebuilt})
        .column("operator", [](auto& r) { return name_of(r.own.kind); })
        .column("best, measured", measured_best)
        .column("formula", {.unit = "best"}, best_of(by_formula))
        .column("draws", {.unit = "best"}, best_of(by_draws))
        .column("first order", {.unit = "best"}, best_of(by_derivative))
        .column("Stein", {.unit = "best"}, best_of(by_stein))
        .column("formula", {.unit = "% off", .digits = 2}, deviation_of(by_formula))
        .column("draws", {.unit = "% off", .digits = 2}, deviation_of(by_draws))
        .column("first order", {.unit = "% off", .digits = 2}, deviation_of(by_derivative))
        .column("Stein", {.unit = "% off", .digits = 2}, deviation_of(by_stein));
}

report::Table why_table(const Studies& studies) {
    const auto share = [](double ErrorAccount::*part) { return [part](const Row& r) { return 100 * (error_account(r.level).*part); }; };
    return begun_table("prediction_why", words.line("why"), studies, {FlowOperator::noisy})
        .column("iteration", [](auto& r) { return std::to_string(error_account(r.level).iteration); })
        .column("formula", {.unit = "% of noise"}, share(&ErrorAccount::formula))
        .column("other numbers", {.unit = "% of noise"}, share(&ErrorAccount::numbers))
        .column("own noise", {.unit = "% of noise"}, share(&ErrorAccount::knowledge))
        .column("measured", {.unit = "% of noise"}, share(&ErrorAccount::measured))
        .column("along, own", {.unit = "% of noise"}, share(&ErrorAccount::along_own))
        .column("along, clean", {.unit = "% of noise"}, share(&ErrorAccount::along_clean))
        .column("across, own", {.unit = "% of noise"}, share(&ErrorAccount::across_own))
        .column("across, clean", {.unit = "% of noise"}, share(&ErrorAccount::across_clean))
        .column("area", {.unit = "× clean"}, [](auto& r) { return r.level.facts.area; })
        .column("negative weights", {.unit = "%", .digits = 2}, [](auto& r) { return 100 * r.level.facts.negative_weights; });
}

report::Table rule_table(const Studies& studies) {
    const NoiseLevelStudy& first = studies.front().levels.front();
    return begun_table("prediction_rule",
                       words.line("rule", "noisy_seeds"_a = first.of(FlowOperator::noisy).rule_seeds,
                                  "rebuilt_seeds"_a = first.of(FlowOperator::rebuilt).rule_seeds, "mesh"_a = studies.front().name()),
                       studies, {FlowOperator::noisy, FlowOperator::rebuilt})
        .column("operator", [](auto& r) { return name_of(r.own.kind); })
        .column("σ̂/σ", [](auto& r) { return cell_of(r.level.mean_sigma_ratio()); })
        .column("best, measured", measured_best)
        .column("chosen", {.unit = "mean"}, chosen_by(by_stein_estimated))
        .column("regret", {.unit = "%", .digits = 2}, regret_of(by_stein_estimated))
        .column("worst", {.unit = "%", .digits = 2}, regret_of(by_stein_estimated, &RuleOutcome::worst_regret))
        .column("σ known", {.unit = "regret, %", .digits = 2}, regret_of(by_stein))
        .column("held fixed", {.unit = "regret, %", .digits = 2}, regret_of(by_fixed_operator))
        .column("discrepancy", {.unit = "chosen"}, chosen_by(by_discrepancy))
        .column("discrepancy", {.unit = "regret, %", .digits = 2}, regret_of(by_discrepancy));
}

report::Plot clean_prediction_plot(const PredictionStudy& study) {
    report::Plot plot = error_plot(study, "clean");
    double off = 0;
    int levels = 0;
    for (const NoiseLevelStudy& level : study.levels) {
        const MeasuredCurve& measured = level.of(FlowOperator::clean).measured;
        const PredictedCurve& formula = level.of(FlowOperator::clean).formula();
        const std::string sigma = "σ = " + readable_percent(level.sigma, 2);
        plot.series.push_back(measured_series(sigma + ", measured", measured));
        plot.series.back().color = levels;
        plot.series.back().pattern = 0;   // a continuous line at every level
        plot.series.push_back(root_series(sigma + ", expected", formula.square, Style::dashed));
        plot.series.back().color = levels++ + 3;   // another colour than that of the line it runs on
        const bool same = formula.best() == measured.best();
        plot.markers.push_back(marker_at(measured.square, measured.best(), same ? "both t = " : "measured t = "));
        if (!same) plot.markers.push_back(marker_at(formula.square, formula.best(), "expected t = "));
        off = std::max(off, deviation(formula, measured));
    }
    plot.caption = words.line("plot.clean", "mesh"_a = study.name(), "seeds"_a = study.seeds, "off"_a = readable_percent(off, 2));
    return plot;
}

report::Plot operator_prediction_plot(const PredictionStudy& study, FlowOperator kind) {
    const NoiseLevelStudy& level = study.levels.back();
    const OperatorStudy& own = level.of(kind);
    report::Plot plot = error_plot(study, name_of(kind));
    plot.series.push_back(measured_series("measured", own.measured));
    // Far beyond what is measured a curve would only flatten the others.
    for (const PredictedCurve& predicted : own.predictions)
        plot.series.push_back(root_series(predicted.name, predicted.square, Style::dashed, 9 * own.measured.square.maxCoeff()));
    plot.markers = {marker_at(own.measured.square, own.measured.best(), "measured t = "),
                    marker_at(own.formula().square, own.formula().best(), "formula t = ")};
    plot.caption = words.line("plot.operator", "mesh"_a = study.name(),
                              "operator"_a = words.line(kind == FlowOperator::noisy ? "plot.operator.noisy" : "plot.operator.rebuilt"),
                              "sigma"_a = readable_percent(level.sigma, 2), "edges"_a = readable(level.sigma_edges, 2),
                              "seeds"_a = study.seeds, "formula"_a = readable_percent(deviation(own.formula(), own.measured), 2),
                              "closest"_a = own.closest().name, "off"_a = readable_percent(deviation(own.closest(), own.measured), 2));
    return plot;
}

}   // namespace meshfolio::prediction
