#include "questions/modes/parts.h"

namespace meshfolio::modes {

namespace {

using Style = report::Series::Style;

constexpr double invisible = 1e-13;       // factors below are rounding
constexpr Eigen::Index most_shown = 60;   // points

std::string relative_step(const ModeStudy& study, double lambda) { return plain_text(lambda / study.subject.critical, 3) + "\u202fλ_crit"; }

/// |factor| where it can be seen above rounding.
double visible(double factor) { return std::abs(factor) > invisible ? std::abs(factor) : undefined; }

report::Series law_line(const ModeStudy& study, const ModeDamping& damping) {
    report::Series line{.name = words.line("factors.law"), .panel = relative_step(study, damping.lambda)};
    constexpr int points = 240;
    for (int i = 0; i <= points; ++i) {
        const double share = double(i) / points;
        add_point(line, share, visible(damping.law(share * study.subject.top.value)));
    }
    return line;
}

/// Picks some of the modes, evenly spaced, with the last.
report::Series measured_points(const ModeStudy& study, const ModeDamping& damping) {
    report::Series points{.name = words.line("factors.measured"), .style = Style::points, .panel = relative_step(study, damping.lambda)};
    const Eigen::Index n = study.eigenvalues.size(), shown = std::min(n, most_shown);
    for (Eigen::Index k = 0; k < shown; ++k) {
        const Eigen::Index i = shown > 1 ? k * (n - 1) / (shown - 1) : 0;
        add_point(points, study.eigenvalues[i] / study.subject.top.value, visible(damping.measured[i]));
    }
    return points;
}

double operations_of(const SmoothingWay& way) { return way.steps > 0 ? way.operations : undefined; }
double error_of(const SmoothingWay& way) { return way.steps > 0 ? 100 * way.error : undefined; }

/// Plots one value of the explicit and of the first implicit ways over energy; ways given by steps and by error have a panel each.
report::Plot target_plot(const ModeStudy& study, const std::string& key, std::size_t implicit_ways, double (*value)(const SmoothingWay&)) {
    report::Plot plot{.id = id_of("modes", study.name(), key),
                      .caption = words.line(key, "mesh"_a = study.name()),
                      .x_label = words.line("targets.x"),
                      .y_label = words.line(key + ".y"),
                      .log_x = true,
                      .log_y = true};
    const auto add = [&](const std::string& name, std::size_t panel, const auto& way_of) {
        const std::string title =
            implicit_ways > std::size(implicit_steps) ? words.line(panel == 0 ? "targets.steps" : "targets.error") : "";
        report::Series series{.name = name, .panel = title};
        for (const SmoothingTarget& target : study.curve) add_point(series, 100 * target.energy, value(way_of(target)));
        plot.series.push_back(std::move(series));
    };
    for (std::size_t which = 0; which < implicit_ways; ++which) {
        const std::size_t panel = which < std::size(implicit_steps) ? 0 : 1;
        if (which == 0 || which == std::size(implicit_steps))
            add(words.line("way.explicit"), panel, [](const SmoothingTarget& t) { return t.explicit_way; });
        add(implicit_way_names()[which], panel, [&](const SmoothingTarget& t) { return t.implicit_ways[which]; });
    }
    return plot;
}

/// An implicit way, and the target from which on it is the cheaper one.
struct CrossingRow {
    const ModeStudy& study;
    std::string name;
    bool there;
    const SmoothingTarget& at;
    const SmoothingWay& way;
};
std::vector<CrossingRow> crossing_rows(const Studies& studies) {
    std::vector<CrossingRow> rows;
    for (const ModeStudy& study : studies) {
        for (std::size_t which = 0; which < study.crossings.size(); ++which) {
            const bool there = !study.cheaper_nowhere(which);
            const SmoothingTarget& at = there ? *study.crossings[which] : study.curve.front();
            rows.push_back({study, implicit_way_names()[which], there, at, at.implicit_ways[which]});
        }
    }
    return rows;
}

}   // namespace

report::Table damping_table(const Studies& studies) {
    const auto top_law = [](auto& r) { return r.part.law(r.whole.eigenvalues[r.whole.eigenvalues.size() - 1]); };
    return table("modes_damping", words.line("damping"), parts_within(studies, &ModeStudy::dampings))
        .column("mesh", [](auto& r) { return r.whole.name(); })
        .column("modes", {.digits = 6}, [](auto& r) { return readable_count(r.whole.eigenvalues.size()) + (r.whole.all ? " (all)" : ""); })
        .column("scheme", [](auto& r) { return scheme_name(r.part.scheme); })
        .column("λ/λ_crit", [](auto& r) { return r.part.lambda / r.whole.subject.critical; })
        .column("steps", {.digits = 4}, [](auto& r) { return r.part.steps; })
        .column(words.line("damping.left"), {.unit = "law", .digits = 5}, top_law)
        .column(words.line("damping.left"), {.unit = "measured", .digits = 5}, [](auto& r) { return r.part.measured.tail(1)[0]; })
        .column("deviation", {.digits = 2}, [](auto& r) { return r.part.deviation(r.whole.eigenvalues); });
}

report::Plot damping_plot(const ModeStudy& study, SmoothingScheme scheme) {
    const std::string name = scheme_name(scheme), key = "factors." + name;
    const bool some = study.all && study.eigenvalues.size() > most_shown;
    report::Plot plot{.id = id_of("modes", study.name(), name),
                      .caption = words.line(key, "steps"_a = study.dampings.front().steps, "mesh"_a = study.name(),
                                            "some"_a = some ? words.line("factors.some") : ""),
                      .x_label = words.line("factors.x"),
                      .y_label = words.line("factors.y"),
                      .log_y = true};
    Names shares;
    for (const ModeDamping& d : study.dampings) {
        if (d.scheme != scheme) continue;
        plot.series.push_back(law_line(study, d));
        plot.series.push_back(measured_points(study, d));
        shares.push_back(relative_step(study, d.lambda));
    }
    plot.alt = words.line(key + ".alt", "modes"_a = study.eigenvalues.size(), "shares"_a = listed(shares));
    return plot;
}

report::Table gap_table(const Studies& studies) {
    return table("modes_gap", words.line("gap"), parts_within(studies, &ModeStudy::gaps))
        .column("mesh", [](auto& r) { return r.whole.name(); })
        .column("λ", {.unit = "length²"}, [](auto& r) { return r.part.lambda; })
        .column("λ/λ_crit", [](auto& r) { return r.part.lambda / r.whole.subject.critical; })
        .column("iterations", {.digits = 5}, [](auto& r) { return r.part.steps; })
        .column("motion", {.unit = "% of box", .digits = 4}, [](auto& r) { return 100 * r.part.motion; })
        .column("gap measured", {.unit = "% of box", .digits = 4}, [](auto& r) { return cell_of(100 * r.part.measured); })
        .column("gap predicted", {.unit = "% of box", .digits = 4},
                [](auto& r) { return cell_of(100 * r.part.predicted, r.part.predicted < 1e10); })
        .column("first order", {.unit = "% of box"}, [](auto& r) { return cell_of(100 * r.part.leading); })
        .column("gap / motion", {.unit = "%"}, [](auto& r) { return cell_of(100 * r.part.measured / r.part.motion); });
}

report::Plot cost_plot(const ModeStudy& study) {
    report::Plot plot = target_plot(study, "operations", study.crossings.size(), operations_of);
    Names crossings;
    for (std::size_t which = 0; which < study.crossings.size(); ++which) {
        if (study.cheaper_nowhere(which)) continue;
        const SmoothingTarget& at = *study.crossings[which];
        if (!study.cheaper_everywhere(which)) {
            const std::string panel = words.line(which < std::size(implicit_steps) ? "targets.steps" : "targets.error");
            plot.markers.push_back({100 * at.energy, operations_of(at.implicit_ways[which]), "", panel});
        }
        crossings.push_back(
            words.line("operations.alt.crossing", "way"_a = implicit_way_names()[which], "energy"_a = readable_percent(at.energy, 2)));
    }
    plot.alt = crossings.empty() ? words.line("operations.alt.none") : words.line("operations.alt", "crossings"_a = listed(crossings));
    return plot;
}

report::Plot truth_plot(const ModeStudy& study) {
    report::Plot plot = target_plot(study, "truth", std::size(implicit_steps), error_of);
    const SmoothingTarget& last = study.curve.back();
    plot.alt =
        words.line("truth.alt", "energy"_a = readable_percent(last.energy, 2), "explicit"_a = readable_percent(last.explicit_way.error, 2),
                   "implicit"_a = readable_percent(last.implicit_ways.front().error, 2));
    return plot;
}

report::Table crossing_table(const Studies& studies) {
    return table("modes_crossing", words.line("crossing"), crossing_rows(studies))
        .column("mesh", [](auto& r) { return r.study.name(); })
        .column("step", {.unit = "explicit steps"}, [](auto& r) { return r.study.implicit_step / r.study.explicit_step; })
        .column("factorisation", {.unit = "explicit steps"}, [](auto& r) { return r.study.factor.factorisation / r.study.explicit_step; })
        .column("down to", {.unit = "% of energy", .digits = 2}, [](auto& r) { return 100 * r.study.curve.back().energy; })
        .column("way", &CrossingRow::name)
        .column("cheaper below", {.unit = "% of energy"}, [](auto& r) { return cell_of(100 * r.at.energy, r.there); })
        .column("steps there", {.digits = 5}, [](auto& r) { return cell_of(r.way.steps, r.there); })
        .column("its error", {.unit = "%"}, [](auto& r) { return cell_of(100 * r.way.error, r.there); })
        .column("explicit error", {.unit = "%"},
                [](auto& r) { return cell_of(100 * r.at.explicit_way.error, r.there && r.at.explicit_way.steps > 0); });
}

}   // namespace meshfolio::modes
