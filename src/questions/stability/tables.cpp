#include "questions/stability/study.h"
#include "report/svg/map_scale.h"

namespace meshfolio::stability {

namespace {

using Style = report::Series::Style;

/// Plots the growth of a mode at about fifteen steps of the run: points as measured, or a dashed line as predicted.
/// @param first  the step to begin with, in strides: points of runs that obey one law alternate
report::Series curve(const std::string& name, const std::string& step, const ModeGrowth& growth, bool measured, double first = 0) {
    report::Series series{.name = name, .style = measured ? Style::points : Style::dashed, .panel = step};
    const int stride = std::max(2, growth.steps() / 15);
    for (int t = static_cast<int>(first * stride); t <= growth.steps(); t += stride)
        add_point(series, t, measured ? growth.factor[t] : growth.predicted(t));
    return series;
}

std::string vertex_text(int vertex) { return vertex >= 0 ? readable_count(vertex) : "–"; }
std::string step_text(int step) { return step > 0 ? readable_count(step) : "never"; }

/// Plots the iteration of blowing up that the modes predict over λ/λ_crit beyond 1.
report::Series predicted_line(const SmoothingMaps& maps, const GrowingModes& modes, std::string name, Style style) {
    report::Series line{.name = std::move(name), .style = style};
    const double first = 1.005, last = maps.relative(maps.lambdas.size() - 1);
    constexpr int points = 120;
    for (int i = 0; i <= points && last > first; ++i) {
        const double step = first * std::pow(last / first, double(i) / points);
        add_point(line, step, modes.blow_up(step * maps.subject.critical));
    }
    return line;
}

/// Returns the panel of one scheme: 100 × values, the limit, predicted and measured blow-ups (explicit), and the letters of the places.
report::Map::Panel panel_of_scheme(const SmoothingMaps& maps, const SchemeMap& scheme, const PlaneValues& values) {
    const auto edges = report::cell_edges({maps.iterations.begin(), maps.iterations.end()}, true);
    report::Map::Panel panel{scheme.name(), {}, {}};
    for (const double value : values) panel.values.push_back(100 * value);
    panel.lines.push_back({.name = "λ_crit", .x = {1, 1}, .y = {edges.front(), edges.back()}, .style = Style::line});
    if (&scheme == &maps.explicit_map()) {
        panel.lines.push_back(predicted_line(maps, maps.top, words.line("map.top"), Style::dashed));
        if (maps.all) panel.lines.push_back(predicted_line(maps, *maps.all, words.line("map.all"), Style::line));
        report::Series& measured = panel.lines.emplace_back(report::Series{.name = words.line("map.measured"), .style = Style::points});
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step)
            if (scheme.blow_up[step] > 0) add_point(measured, maps.relative(step), scheme.blow_up[step]);
    }
    for (const MapPlace& place : maps.places)
        if (place.scheme == scheme.scheme)
            panel.markers.push_back({maps.relative(place.step), double(maps.iterations[place.row]), place.letter});
    return panel;
}

/// Maps the error from the clean mesh over λ/λ_crit and t, or the motion if no clean mesh is known [% of box]; explicit beside implicit.
report::Map error_map(const SmoothingMaps& maps) {
    const bool known = maps.clean.has_value();
    const std::string key = known ? "error.clean" : "error.input";
    report::Map map{.id = id_of("stability", maps.name(), "error"),
                    .caption = words.line(key + ".caption", "mesh"_a = maps.name(), "input"_a = readable(100 * maps.input_error),
                                          "critical"_a = readable(maps.subject.critical, 4)),
                    .x_label = "step λ/λ_crit",
                    .y_label = "iterations t",
                    .value_label = words.line(key),
                    .y = {maps.iterations.begin(), maps.iterations.end()},
                    .log_x = true,
                    .log_y = true,
                    .log_values = true,
                    .undefined = words.line("map.undefined")};
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) map.x.push_back(maps.relative(step));
    Names ranges;
    for (const SchemeMap& scheme : maps.schemes) {
        map.panels.push_back(panel_of_scheme(maps, scheme, known ? scheme.error : scheme.moved));
        const std::vector<double>& values = map.panels.back().values;
        const ValueSummary s = summary_of(Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size())));
        const std::string_view range = s.count == 0 ? "map.range.nowhere" : s.undefined == 0 ? "map.range" : "map.range.in_part";
        ranges.push_back(words.line(range, "scheme"_a = scheme.name(), "low"_a = readable(s.minimum), "high"_a = readable(s.maximum),
                                    "undefined"_a = s.undefined));
    }
    map.alt = words.line("map.alt", "quantity"_a = map.value_label, "mesh"_a = maps.name(), "ranges"_a = listed(ranges));

    if (known) {   // blue where smoothing gains, red where it spoils
        map.colours = report::Map::Colours::diverging;
        map.middle = 100 * maps.input_error;
        map.range = report::Map::Range{0.5 * map.middle, 2 * map.middle};
        return map;
    }
    report::Map::Range range{infinity, 0};   // of implicit runs alone: explicit ones that blow up would stretch the scale
    for (const double x : map.panels.back().values)
        if (x > 0 && std::isfinite(x)) range = {std::min(range.low, x), std::max(range.high, x)};
    if (range.high > 0) map.range = range;
    return map;
}

}   // namespace

void add_error_maps(report::Section& section, const Planes& planes) {
    for (const SmoothingMaps& maps : planes) add(section, error_map(maps));
}

// The safe step has twelve digits before it is rounded down, which hide the rounding that its bound counts in.

report::Table certificate_table(const Studies& studies) {
    return table("stability_certificates", words.line("certificates"), parts_within(studies, &StabilityStudy::limits))
        .column("mesh", {.filter = true}, [](auto& r) { return r.whole.name(); })
        .column("operator", {.filter = true}, [](auto& r) { return r.part.name; })
        .column("stable up to λ", {.unit = "length², rounded down", .digits = 10, .rounding = Rounding::down},
                [](auto& r) { return r.part.certificate.lambda_low(); })
        .column("unstable beyond λ", {.unit = "length², rounded up", .digits = 10, .rounding = Rounding::up},
                [](auto& r) { return r.part.certificate.lambda_high(); })
        .column("width", {.unit = "relative", .digits = 2, .rounding = Rounding::up},
                [](auto& r) { return r.part.certificate.relative_width(); })
        .column("below 0", {.unit = "of μ_max", .digits = 2, .rounding = Rounding::up},
                [](auto& r) { return -r.part.certificate.bottom.mu_low / r.part.certificate.mu_high; })
        .column("safe λ", {.unit = "length², rounded down", .digits = 4, .rounding = Rounding::down},
                [](auto& r) { return rounded(r.part.certificate.lambda_safe(), 12); });
}

report::Table unit_table(const Studies& studies) {
    const auto tau = [](const StabilityStudy& s, double lambda) {
        return step_in_units(lambda, s.cotangent().critical(), s.mean_edge).tau;
    };
    return table("stability_units", words.line("units"), studies)
        .column("mesh", &StabilityStudy::name)
        .column("λ_crit/h̄²", [](auto& s) { return step_in_units(s.cotangent().critical(), s.cotangent().critical(), s.mean_edge).h2; })
        .column("safe λ", {.unit = "τ, rounded down", .digits = 4, .rounding = Rounding::down},
                [=](auto& s) { return rounded(tau(s, s.cotangent().certificate.lambda_safe()), 12); })
        .column("0.01 h̄²", {.unit = "τ"}, [=](auto& s) { return tau(s, 0.01 * s.mean_edge * s.mean_edge); })
        .column("ten steps of τ = ½", {.unit = "% of box"},
                [](auto& s) { return 100 * smoothing_strength(5 * s.cotangent().critical(), bounding_box(s.mesh()).diagonal()); })
        .column("vertex", {.digits = 8}, [](auto& s) { return s.limiting.vertex; })
        .column("sharing", {.unit = "vertices"}, [](auto& s) { return s.cotangent().certificate.top.support; })
        .column("area", {.unit = "of median", .digits = 2}, [](auto& s) { return s.limiting.area_share; })
        .column("weights", {.unit = "of median", .digits = 2}, [](auto& s) { return s.limiting.stiffness_share; })
        .column("smallest angle", {.unit = "°", .digits = 2}, [](auto& s) { return s.limiting.smallest_angle * 180 / pi; });
}

report::Plot growth_plot(const Studies& studies) {
    const StabilityStudy& study = studies.back();   // all meshes obey one law
    const OperatorLimit &cotangent = study.cotangent(), &uniform = study.uniform();
    const auto end = [](const ModeGrowth& growth, int digits) { return readable(growth.factor.back(), digits); };
    report::Plot plot{.id = id_of("stability", study.name(), "growth"),
                      .caption = words.line("growth", "mesh"_a = study.name(), "steps"_a = cotangent.beyond.steps()),
                      .x_label = "step",
                      .y_label = words.line("growth.y"),
                      .log_y = true};
    plot.alt = words.line("growth.alt", "caption"_a = plot.caption, "cotangent_beyond"_a = end(cotangent.beyond, 4),
                          "uniform_beyond"_a = end(uniform.beyond, 4), "cotangent_below"_a = end(cotangent.below, 3),
                          "uniform_below"_a = end(uniform.below, 3));
    for (const OperatorLimit* limit : {&cotangent, &uniform}) {
        const double first = limit == &cotangent ? 0 : 0.5;
        plot.series.push_back(curve(limit->name, "1.01 λ_crit", limit->beyond, true, first));
        plot.series.push_back(curve(limit->name, "0.99 λ_crit", limit->below, true, first));
    }
    plot.series.push_back(curve("predicted", "1.01 λ_crit", cotangent.beyond, false));
    plot.series.push_back(curve("predicted", "0.99 λ_crit", cotangent.below, false));
    return plot;
}

report::Table flow_table(const RebuiltFlow& flow) {
    return table(id_of("stability", flow.name(), "flow_table"),
                 words.line("flow_runs", "mesh"_a = flow.name(), "diagonals"_a = readable(SmoothingOptions().blow_up_at),
                            "steps"_a = flow.fixed.iterations, "share"_a = readable(flow.share, 3), "beyond"_a = readable(flow.beyond, 1),
                            "frozen_steps"_a = flow.frozen.iterations),
                 flow.runs())
        .column("run", &WatchedRun::name)
        .column("largest λμ_max", {.digits = 4}, [](auto& r) { return largest_product(r->run); })
        .column("beyond 2 in step", [](auto& r) { return step_text(r->run.crossing_iteration); })
        .column("at vertex", [](auto& r) { return vertex_text(r->run.crossing_vertex); })
        .column(words.line("flow_runs.turned"), [](auto& r) { return step_text(r->turned_iteration); })
        .column("blew up in step", [](auto& r) { return step_text(r->run.blow_up_iteration); })
        .column("at vertex", {.unit = "first"}, [](auto& r) { return vertex_text(r->run.blow_up_vertex); })
        .column("turned at the end", {.unit = "faces", .digits = 6}, &WatchedRun::inverted)
        .column("last λ", {.unit = "of the first"}, [](auto& r) { return r->run.steps.back().lambda / r->lambda; })
        .column("time reached", {.unit = "% of steps × λ"}, [](auto& r) { return 100 * r->run.time / (r->lambda * r->iterations); })
        .column("ended by", [](auto& r) {
            return r->run.blew_up ? "blow-up" : r->run.collapse_iteration > 0 ? "collapse" : "number of steps";
        });
}

report::Plot flow_plot(const RebuiltFlow& flow) {
    const Smoothed &fixed = flow.fixed.run, &frozen = flow.frozen.run;
    const auto largest = [](const Smoothed& run) { return readable(largest_product(run), 3); };
    const std::string until =
        frozen.blew_up ? words.line("flow.until", "step"_a = frozen.blow_up_iteration, "vertex"_a = frozen.blow_up_vertex) : "";
    report::Plot plot{
        .id = id_of("stability", flow.name(), "flow"),
        .caption = words.line("flow", "mesh"_a = flow.name(), "first"_a = readable(fixed.steps.front().top, 3), "fixed"_a = largest(fixed),
                              "adaptive"_a = largest(flow.adaptive.run), "frozen"_a = largest(frozen), "until"_a = until),
        .x_label = "step",
        .y_label = words.line("flow.y"),
        .log_y = true};
    for (const WatchedRun* watched : flow.runs()) {
        report::Series& series = plot.series.emplace_back(report::Series{.name = watched->name, .style = Style::line_and_points});
        for (const StepStability& step : watched->run.steps) add_point(series, double(series.x.size() + 1), step.top);
    }
    plot.series.push_back({.name = "limit 2", .x = {1, double(flow.fixed.iterations)}, .y = {2, 2}, .style = Style::dashed});
    return plot;
}

report::Table blow_up_table(const Planes& planes) {
    struct Row {
        const SmoothingMaps& maps;
        std::size_t step;
    };
    std::vector<Row> rows;   // some of the steps beyond the limit, evenly spaced
    constexpr std::size_t most = 4;
    for (const SmoothingMaps& maps : planes) {
        std::vector<std::size_t> beyond;
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step)
            if (maps.lambdas[step] > maps.subject.critical) beyond.push_back(step);
        const std::size_t chosen = std::min(most, beyond.size());
        for (std::size_t i = 0; i < chosen; ++i) rows.push_back({maps, beyond[chosen < most ? i : i * (beyond.size() - 1) / (most - 1)]});
    }
    const auto predicted = [](const Row& r, const GrowingModes& modes) {
        const double iteration = modes.blow_up(r.maps.lambdas[r.step]);
        return cell_of(iteration, iteration <= r.maps.iterations.back());
    };
    return table("stability_blow_up", words.line("blow_up", "iterations"_a = planes.front().iterations.back()), rows)
        .column("mesh", [](auto& r) { return r.maps.name(); })
        .column("λ/λ_crit", {.digits = 4}, [](auto& r) { return r.maps.relative(r.step); })
        .column("|1 − λμ_max|", {.unit = "a step", .digits = 4},
                [](auto& r) { return std::abs(1 - r.maps.lambdas[r.step] * r.maps.subject.top.value); })
        .column("top mode", {.unit = "iteration"}, [=](auto& r) { return predicted(r, r.maps.top); })
        .column("all modes", {.unit = "iteration"}, [=](auto& r) { return r.maps.all ? predicted(r, *r.maps.all) : report::Cell(); })
        .column("measured", {.unit = "iteration", .digits = 6}, [](auto& r) {
            const int measured = r.maps.explicit_map().blow_up[r.step];
            return cell_of(measured, measured > 0);
        });
}

report::Table region_table(const Planes& planes) {
    const auto cells_where = [](const auto& chosen) { return [=](auto& r) { return std::ranges::count_if(r.part.inverted, chosen); }; };
    const auto at_best = [](const auto& value) {
        return [=](auto& r) {
            const auto best = r.whole.best(r.part);
            return best ? cell_of(value(r.whole, r.part, *best)) : report::Cell();
        };
    };
    return table("stability_regions", words.line("regions"), parts_within(planes, &SmoothingMaps::schemes))
        .column("mesh", [](auto& r) { return r.whole.name(); })
        .column("scheme", [](auto& r) { return r.part.name(); })
        .column("cells", {.digits = 6}, [](auto& r) { return r.part.moved.size(); })
        .column("usable", {.digits = 6}, cells_where([](double x) { return std::isfinite(x); }))
        .column("turned", {.unit = "cells", .digits = 6}, cells_where([](double x) { return x > 0; }))
        .column("at most", {.unit = "% of triangles"}, [](auto& r) { return 100 * largest_of(r.part.inverted, std::identity()); })
        .column("best error", {.unit = "% of box"}, at_best([](auto&, auto& map, auto i) { return 100 * map.error[i]; }))
        .column("error left", {.unit = "% of the input's"},
                at_best([](auto& maps, auto& map, auto i) { return 100 * map.error[i] / maps.input_error; }))
        .column("at λ/λ_crit", at_best([](auto& maps, auto&, auto i) { return maps.relative(maps.step_of(i)); }))
        .column("iterations", {.digits = 5}, at_best([](auto& maps, auto&, auto i) { return maps.iterations[maps.row_of(i)]; }));
}

}   // namespace meshfolio::stability
