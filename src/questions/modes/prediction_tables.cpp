#include "questions/modes/prediction_study.h"

namespace meshfolio::modes {

namespace {

using Style = report::Series::Style;

/// One operator at one level of noise on one mesh.
struct Row {
    const PredictionStudy& study;
    const NoiseLevelStudy& level;
    const OperatorStudy& own;
};

/// Makes a table with a row for each level of each mesh and the columns mesh and noise.
auto begun_table(std::string id, std::string caption, const PredictionStudies& studies, FlowOperator kind = FlowOperator::noisy) {
    std::vector<Row> rows;
    for (const auto& [study, level] : levels_of(studies)) rows.push_back({study, level, level.of(kind)});
    auto begun = table(std::move(id), std::move(caption), std::move(rows));
    begun.column("mesh", [](auto& r) { return r.study.name(); })
        .column("σ", {.unit = "% of box"}, [](auto& r) { return 100 * r.level.sigma; })
        .column("σ", {.unit = "mean edges"}, [](auto& r) { return r.level.sigma / r.study.mean_edge; });
    return begun;
}

/// Returns "23", or "40, still falling" at the end of the run.
std::string best_words(int best, const OperatorStudy& own) {
    return std::to_string(best) + (best < own.measured.iterations() || best == 0 ? "" : ", still falling");
}
std::string measured_best(const Row& r) { return best_words(r.own.measured.best(), r.own); }
std::string formula_best(const Row& r) { return best_words(r.own.formula().best(), r.own); }

/// Shows the largest deviation of a prediction.
auto deviation_of(std::string_view name) {
    return [=](const Row& r) { return 100 * deviation(*r.own.prediction(name), r.own.measured); };
}

/// Shows the mean iteration that a rule chose; an empty cell if it was not tried.
auto chosen_by(std::string_view name) {
    return [=](const Row& r) {
        const RuleOutcome* rule = r.own.rule(name);
        return rule != nullptr ? report::Cell(rule->mean_chosen) : report::Cell();
    };
}

/// Shows the regret of a rule; an empty cell if it was not tried or the minimum is not known.
auto regret_of(std::string_view name, double RuleOutcome::*regret = &RuleOutcome::mean_regret) {
    return [=](const Row& r) {
        const RuleOutcome* rule = r.own.rule(name);
        return rule != nullptr ? cell_of(100 * rule->*regret, r.own.minimum_reached()) : report::Cell();
    };
}

/// Plots √ of the values in % of the box. Negative values and values above `most` leave gaps.
report::Series root_series(std::string name, std::string panel, const Vector& square, Style style, double most = infinity) {
    report::Series series{.name = std::move(name), .style = style, .panel = std::move(panel)};
    for (Eigen::Index t = 0; t < square.size(); ++t)
        add_point(series, double(t), square[t] >= 0 && square[t] <= most ? 100 * std::sqrt(square[t]) : undefined);
    return series;
}

report::Series measured_series(std::string name, std::string panel, const MeasuredCurve& measured) {
    report::Series series = root_series(std::move(name), std::move(panel), measured.square, Style::line);
    for (Eigen::Index t = 0; t < measured.square.size(); ++t) {
        series.y_low.push_back(100 * measured.low[t]);
        series.y_high.push_back(100 * measured.high[t]);
    }
    return series;
}

/// Marks iteration t of a curve: "measured t = 7", or "still falling, t = 40" at its end.
report::Marker marker_at(const std::string& panel, const Vector& square, int t, std::string label) {
    if (t > 0 && t + 1 == square.size()) label = "still falling, t = ";
    return {static_cast<double>(t), 100 * std::sqrt(std::max(square[t], 0.0)), label + std::to_string(t), panel};
}

}   // namespace

report::Table expected_table(const PredictionStudies& studies) {
    report::FactList by_probes;
    for (const PredictionStudy& study : studies)
        if (study.prediction.probes > 0) by_probes.push_back({"mesh"_a = study.name(), "probes"_a = study.prediction.probes});
    return begun_table("modes_expected", words.line("expected", "seeds"_a = studies.front().seeds, "by_probes"_a = by_probes), studies,
                       FlowOperator::clean)
        .column("best iteration, expected", formula_best)
        .column("best iteration, measured", measured_best)
        .column("error, expected", {.unit = "% of box", .digits = 4},
                [](auto& r) { return 100 * std::sqrt(r.own.formula().square[r.own.measured.best()]); })
        .column("error, measured", {.unit = "% of box", .digits = 4},
                [](auto& r) { return 100 * std::sqrt(r.own.measured.square[r.own.measured.best()]); })
        .column("farthest, vertices", {.unit = "%", .digits = 2}, [](auto& r) { return 100 * deviation(r.own.formula(), r.own.measured); })
        .column("farthest, area", {.unit = "%", .digits = 2}, [](auto& r) { return 100 * largest_mass_deviation(r.study, r.level); })
        .column("farthest", {.unit = "std. errors", .digits = 2}, [](auto& r) { return standard_distance(r.study, r.level).larger(); })
        .column("regret", {.unit = "%", .digits = 2}, [](auto& r) { return 100 * r.own.regret_of_formula; });
}

report::Table own_operator_table(const PredictionStudies& studies) {
    int collapsed = 0;
    for (const auto& [study, level] : levels_of(studies)) collapsed += level.of(FlowOperator::noisy).collapsed;
    return begun_table("modes_own",
                       words.line("own", "seeds"_a = studies.front().seeds, "draws"_a = studies.front().draws, "collapsed"_a = collapsed),
                       studies)
        .column("best iteration, measured", measured_best)
        .column("best iteration, formula", formula_best)
        .column("formula", {.unit = "% off", .digits = 2}, deviation_of(by_formula))
        .column("draws", {.unit = "% off", .digits = 2}, deviation_of(by_draws))
        .column("Stein", {.unit = "% off", .digits = 2}, deviation_of(by_stein));
}

report::Table why_table(const PredictionStudies& studies) {
    const auto share = [](double ErrorAccount::*part) { return [part](const Row& r) { return 100 * (error_account(r.level).*part); }; };
    return begun_table("modes_why", words.line("why"), studies)
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

report::Table rule_table(const PredictionStudies& studies) {
    return begun_table("modes_rules",
                       words.line("rules", "seeds"_a = studies.front().levels.front().of(FlowOperator::noisy).rule_seeds,
                                  "mesh"_a = studies.front().name()),
                       studies)
        .column("σ̂/σ", [](auto& r) { return cell_of(r.level.sigma_ratio); })
        .column("best, measured", measured_best)
        .column("chosen", {.unit = "mean"}, chosen_by(by_stein_estimated))
        .column("regret", {.unit = "%", .digits = 2}, regret_of(by_stein_estimated))
        .column("worst", {.unit = "%", .digits = 2}, regret_of(by_stein_estimated, &RuleOutcome::worst_regret))
        .column("σ known", {.unit = "regret, %", .digits = 2}, regret_of(by_stein))
        .column("held fixed", {.unit = "regret, %", .digits = 2}, regret_of(by_fixed_operator))
        .column("discrepancy", {.unit = "chosen"}, chosen_by(by_discrepancy))
        .column("discrepancy", {.unit = "regret, %", .digits = 2}, regret_of(by_discrepancy));
}

report::Plot expected_plot(const PredictionStudies& studies) {
    report::Plot plot{.id = "modes_expected_errors",
                      .caption = words.line("expected.plot", "seeds"_a = studies.front().seeds),
                      .x_label = "iteration",
                      .y_label = words.line("plot.y"),
                      .log_y = true};
    for (const PredictionStudy& study : studies) {
        const std::string& panel = study.name();
        int levels = 0;
        for (const NoiseLevelStudy& level : study.levels) {
            const MeasuredCurve& measured = level.of(FlowOperator::clean).measured;
            const PredictedCurve& formula = level.of(FlowOperator::clean).formula();
            const std::string sigma = "σ = " + readable_percent(level.sigma, 2);
            plot.series.push_back(measured_series(sigma + ", measured", panel, measured));
            plot.series.back().color = levels;
            plot.series.back().pattern = 0;   // a continuous line at every level
            plot.series.push_back(root_series(sigma + ", expected", panel, formula.square, Style::dashed));
            plot.series.back().color = levels++ + 3;   // another colour than that of the line it runs on
            const bool same = formula.best() == measured.best();
            plot.markers.push_back(marker_at(panel, measured.square, measured.best(), same ? "both t = " : "measured t = "));
            if (!same) plot.markers.push_back(marker_at(panel, formula.square, formula.best(), "expected t = "));
        }
    }
    return plot;
}

report::Plot own_operator_plot(const PredictionStudies& studies) {
    report::Plot plot{.id = "modes_own_errors",
                      .caption = words.line("own.plot", "seeds"_a = studies.front().seeds,
                                            "sigma"_a = readable_percent(studies.front().levels.back().sigma, 2)),
                      .x_label = "iteration",
                      .y_label = words.line("plot.y"),
                      .log_y = true};
    for (const PredictionStudy& study : studies) {
        const OperatorStudy& own = study.levels.back().of(FlowOperator::noisy);
        plot.series.push_back(measured_series("measured", study.name(), own.measured));
        // Values far above the measured ones would flatten the other curves.
        for (const PredictedCurve& predicted : own.predictions)
            plot.series.push_back(
                root_series(predicted.name, study.name(), predicted.square, Style::dashed, 9 * own.measured.square.maxCoeff()));
        plot.markers.push_back(marker_at(study.name(), own.measured.square, own.measured.best(), "measured t = "));
        plot.markers.push_back(marker_at(study.name(), own.formula().square, own.formula().best(), "formula t = "));
    }
    return plot;
}

void add_noise_checks(report::Section& section, const PredictionStudies& studies) {
    constexpr double far = 5, wrong = 1.5;
    for (const auto& [study, level] : levels_of(studies)) {
        const auto name = [&mesh = study.name(), sigma = plain_text(100 * level.sigma, 3)](const char* key) {
            return words.line(key, "sigma"_a = sigma, "mesh"_a = mesh);
        };
        const StandardDistance right = standard_distance(study, level), control = standard_distance(study, level, wrong);
        append_checks(section, {check_at_most(name("check.vertices"), far, right.vertices, 0,
                                              words.line("check.vertices.note", "seeds"_a = study.seeds)),
                                check_at_most(name("check.area"), far, right.mass)});
        // Rounding may hide the difference between a right and a wrong formula.
        if (study.condition < 1e12) add(section, check_at_least(name("check.control"), far, control.vertices));
        // p(t) is the expected, m(t) the measured curve, off by δ at most: m(t_p) ≤ (1 + δ)p(t_p) ≤ (1 + δ)p(t_m) ≤ m(t_m)(1 + δ)/(1 − δ).
        const OperatorStudy& clean = level.of(FlowOperator::clean);
        const double off = deviation(clean.formula(), clean.measured);
        if (off < 0.5) add(section, check_at_most(name("check.regret"), (1 + off) / (1 - off) - 1, clean.regret_of_formula, 1e-12));
    }
}

}   // namespace meshfolio::modes
