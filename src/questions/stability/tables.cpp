#include "questions/stability/parts.h"
#include "report/svg/map_scale.h"

namespace meshfolio::stability {

namespace {

using Style = report::Series::Style;

struct OperatorRow {
    const StabilityStudy& study;
    const OperatorLimit& limit;
};
std::vector<OperatorRow> operator_rows(const Studies& studies) {
    std::vector<OperatorRow> rows;
    for (const StabilityStudy& study : studies)
        for (const OperatorLimit* limit : study.operators()) rows.push_back({study, *limit});
    return rows;
}

/// A bound to twelve digits: it differs from 1, say, by less only because its own rounding is counted in.
double but_for_rounding(double bound) { return rounded(bound, 12); }

/// |1 − λμ|ᵗ or what was measured of it, at some fifteen steps of the run.
/// @param first  step to begin with: runs that obey one law would hide each other, so their points alternate
report::Series curve(const std::string& name, const std::string& step, const ModeGrowth& growth, bool measured, double first = 0) {
    report::Series series{.name = name, .style = measured ? Style::points : Style::dashed, .panel = step};
    const int stride = std::max(2, growth.steps() / 15);
    for (int t = static_cast<int>(first * stride); t <= growth.steps(); t += stride)
        add_point(series, t, measured ? growth.factor[t] : growth.predicted(t));
    return series;
}

std::string vertex_text(int vertex) { return vertex >= 0 ? readable_count(vertex) : "–"; }

std::string when(int iteration) { return iteration > 0 ? readable_count(iteration) : "never"; }

const char* end_of(const Smoothed& run) { return run.blew_up ? "blow-up" : run.collapse_iteration > 0 ? "collapse" : "number of steps"; }

report::Series limit_line(const report::Map& map) {
    const auto edges = report::cell_edges(map.y, map.log_y);
    return {.name = "λ_crit", .x = {1, 1}, .y = {edges.front(), edges.back()}, .style = Style::line};
}

/// The predicted iterations of blowing up within the plane.
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

report::Series measured_points(const SmoothingMaps& maps) {
    report::Series points{.name = words.line("map.measured"), .style = Style::points};
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step)
        if (maps.explicit_map.blow_up[step] > 0) add_point(points, maps.relative(step), maps.explicit_map.blow_up[step]);
    return points;
}

report::Map::Panel panel_of_scheme(const SmoothingMaps& maps, const SchemeMap& scheme, const report::Map& map,
                                   PlaneValues SchemeMap::*quantity, double unit) {
    report::Map::Panel panel{scheme.name(), {}, {limit_line(map)}};
    for (const double value : scheme.*quantity) panel.values.push_back(unit * value);
    if (&scheme == &maps.explicit_map) {
        panel.lines.push_back(predicted_line(maps, maps.top, words.line("map.top"), Style::dashed));
        if (maps.all) panel.lines.push_back(predicted_line(maps, *maps.all, words.line("map.all"), Style::line));
        panel.lines.push_back(measured_points(maps));
    }
    for (const MapPlace& place : maps.places)
        if (place.scheme == scheme.scheme)
            panel.markers.push_back({maps.relative(place.step), double(maps.iterations[place.row]), place.letter});
    return panel;
}

/// "explicit from 0.1 to 3, implicit from 0.1 to 50" of what is defined.
std::string ranges_of(const report::Map& map) {
    Names parts;
    for (const report::Map::Panel& panel : map.panels) {
        const ValueSummary s = summary_of(Eigen::Map<const Vector>(panel.values.data(), Eigen::Index(panel.values.size())));
        parts.push_back(words.line(s.count == 0       ? "map.range.nowhere"
                                   : s.undefined == 0 ? "map.range"
                                                      : "map.range.in_part",
                                   "scheme"_a = panel.title, "low"_a = readable(s.minimum), "high"_a = readable(s.maximum),
                                   "undefined"_a = s.undefined));
    }
    return listed(parts);
}

/// One quantity over the plane, with axes, lines and letters.
/// @param key  of its name; its caption is "<key>.caption"
/// @param unit  values are shown in
report::Map plane_of(const SmoothingMaps& maps, const std::string& id, const std::string& key, PlaneValues SchemeMap::*quantity,
                     double unit, const std::string& input = "") {
    report::Map map{.id = id_of("stability", maps.name(), id),
                    .caption = words.line(key + ".caption", "mesh"_a = maps.name(), "input"_a = input,
                                          "critical"_a = readable(maps.subject.critical, 4)),
                    .x_label = "step λ/λ_crit",
                    .y_label = "iterations t",
                    .value_label = words.line(key),
                    .y = {maps.iterations.begin(), maps.iterations.end()},
                    .log_x = true,
                    .log_y = true,
                    .undefined = words.line("map.undefined")};
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) map.x.push_back(maps.relative(step));
    for (const SchemeMap* scheme : maps.maps()) map.panels.push_back(panel_of_scheme(maps, *scheme, map, quantity, unit));
    map.alt = words.line("map.alt", "quantity"_a = map.value_label, "mesh"_a = maps.name(), "ranges"_a = ranges_of(map));
    return map;
}

/// The range of the positive finite values; empty where there are none.
std::optional<report::Map::Range> finite_range(const PlaneValues& values) {
    report::Map::Range range{infinity, 0};
    for (const double x : values) {
        if (!(x > 0 && std::isfinite(x))) continue;
        range.low = std::min(range.low, x);
        range.high = std::max(range.high, x);
    }
    if (range.high > 0) return range;
    return {};
}

struct StepRow {
    const SmoothingMaps& maps;
    std::size_t step;

    /// The predicted iteration, if it lies within the plane.
    report::Cell predicted(const GrowingModes* modes) const {
        const double iteration = modes ? modes->blow_up(maps.lambdas[step]) : undefined;
        return cell_of(iteration, iteration <= maps.iterations.back());
    }
};

/// Picks some of the steps beyond the limit, evenly spaced.
std::vector<StepRow> steps_beyond(const Planes& planes, std::size_t most) {
    std::vector<StepRow> rows;
    for (const SmoothingMaps& maps : planes) {
        std::vector<std::size_t> beyond;
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step)
            if (maps.lambdas[step] > maps.subject.critical) beyond.push_back(step);
        const std::size_t chosen = std::min(most, beyond.size());
        for (std::size_t i = 0; i < chosen; ++i) rows.push_back({maps, beyond[chosen < most ? i : i * (beyond.size() - 1) / (most - 1)]});
    }
    return rows;
}

struct SchemeRow {
    const SmoothingMaps& maps;
    const SchemeMap& map;
    std::optional<std::size_t> best = maps.best(map);

    double error() const { return best ? map.error[*best] : undefined; }
    double lambda() const { return best ? maps.lambdas[maps.step_of(*best)] : undefined; }
    double iterations() const { return best ? maps.iterations[maps.row_of(*best)] : undefined; }
    /// Cells neither blown up nor too small to measure.
    std::ptrdiff_t usable() const {
        return std::ranges::count_if(map.inverted, [](double x) { return std::isfinite(x); });
    }
    std::ptrdiff_t turned() const {
        return std::ranges::count_if(map.inverted, [](double x) { return x > 0; });
    }
    double most_turned() const { return largest_of(map.inverted, std::identity()); }
};
std::vector<SchemeRow> scheme_rows(const Planes& planes) {
    std::vector<SchemeRow> rows;
    for (const SmoothingMaps& maps : planes)
        for (const SchemeMap* map : maps.maps()) rows.push_back({maps, *map});
    return rows;
}

/// A cell of the plane of one scheme.
struct PlaneCell {
    const SmoothingMaps& maps;
    const SchemeMap& map;
    std::size_t i;
};
std::vector<PlaneCell> cells_of(const Planes& planes) {
    std::vector<PlaneCell> cells;
    for (const SmoothingMaps& maps : planes)
        for (const SchemeMap* map : maps.maps())
            for (std::size_t i = 0; i < map->moved.size(); ++i) cells.push_back({maps, *map, i});
    return cells;
}

}   // namespace

double over_predicted(const ModeGrowth& growth) { return growth.factor.back() / growth.predicted(growth.steps()); }

report::Table certificate_table(const Studies& studies) {
    return table("stability_certificates", words.line("certificates"), operator_rows(studies))
        .column("mesh", [](auto& r) { return r.study.name(); })
        .column("operator", [](auto& r) { return r.limit.name; })
        .column("stable up to λ", {.unit = "length², rounded down", .digits = 10, .rounding = Rounding::down},
                [](auto& r) { return r.limit.certificate.lambda_low(); })
        .column("unstable beyond λ", {.unit = "length², rounded up", .digits = 10, .rounding = Rounding::up},
                [](auto& r) { return r.limit.certificate.lambda_high(); })
        .column("width", {.unit = "relative", .digits = 2, .rounding = Rounding::up},
                [](auto& r) { return r.limit.certificate.relative_width(); })
        .column("below 0", {.unit = "of μ_max", .digits = 2, .rounding = Rounding::up},
                [](auto& r) { return -r.limit.certificate.bottom.mu_low / r.limit.certificate.mu_high; })
        .column("safe λ", {.unit = "length², rounded down", .digits = 4, .rounding = Rounding::down},
                [](auto& r) { return but_for_rounding(r.limit.certificate.lambda_safe()); });
}

report::Table unit_table(const Studies& studies) {
    const auto tau = [](const StabilityStudy& s, double lambda) { return step_in_units(lambda, s.cotangent.critical(), s.mean_edge).tau; };
    return table("stability_units", words.line("units"), studies)
        .column("mesh", &StabilityStudy::name)
        .column("λ_crit/h̄²", [](auto& s) { return step_in_units(s.cotangent.critical(), s.cotangent.critical(), s.mean_edge).h2; })
        .column("safe λ", {.unit = "τ, rounded down", .digits = 4, .rounding = Rounding::down},
                [=](auto& s) { return but_for_rounding(tau(s, s.cotangent.certificate.lambda_safe())); })
        .column("0.01 h̄²", {.unit = "τ"}, [=](auto& s) { return tau(s, 0.01 * s.mean_edge * s.mean_edge); })
        .column("ten steps of τ = ½", {.unit = "% of box"},
                [](auto& s) { return 100 * smoothing_strength(5 * s.cotangent.critical(), s.diagonal); })
        .column("vertex", {.digits = 8}, [](auto& s) { return s.limiting.vertex; })
        .column("sharing", {.unit = "vertices"}, [](auto& s) { return s.cotangent.certificate.top.support; })
        .column("area", {.unit = "of median", .digits = 2}, [](auto& s) { return s.limiting.area_share; })
        .column("weights", {.unit = "of median", .digits = 2}, [](auto& s) { return s.limiting.stiffness_share; })
        .column("smallest angle", {.unit = "°", .digits = 2}, [](auto& s) { return s.limiting.smallest_angle * 180 / pi; });
}

report::Plot growth_plot(const StabilityStudy& study) {
    const auto end = [](const ModeGrowth& growth, int digits) { return readable(growth.factor.back(), digits); };
    report::Plot plot{.id = id_of("stability", study.name(), "growth"),
                      .caption = words.line("growth", "mesh"_a = study.name(), "steps"_a = study.cotangent.beyond.steps()),
                      .x_label = "step",
                      .y_label = words.line("growth.y"),
                      .log_y = true};
    plot.alt = words.line("growth.alt", "caption"_a = plot.caption, "cotangent_beyond"_a = end(study.cotangent.beyond, 4),
                          "uniform_beyond"_a = end(study.uniform.beyond, 4), "cotangent_below"_a = end(study.cotangent.below, 3),
                          "uniform_below"_a = end(study.uniform.below, 3));
    for (const OperatorLimit* limit : study.operators()) {
        const double first = limit == &study.cotangent ? 0 : 0.5;
        plot.series.push_back(curve(limit->name, "1.01 λ_crit", limit->beyond, true, first));
        plot.series.push_back(curve(limit->name, "0.99 λ_crit", limit->below, true, first));
    }
    plot.series.push_back(curve("predicted", "1.01 λ_crit", study.cotangent.beyond, false));
    plot.series.push_back(curve("predicted", "0.99 λ_crit", study.cotangent.below, false));
    return plot;
}

report::Table flow_table(const RebuiltFlow& flow) {
    return table(id_of("stability", flow.name(), "flow_table"),
                 words.line("flow_runs", "mesh"_a = flow.name(), "diagonals"_a = readable(SmoothingOptions().blow_up_at),
                            "steps"_a = flow.iterations, "share"_a = readable(flow.share, 3), "beyond"_a = readable(flow.beyond, 1),
                            "frozen_steps"_a = flow.frozen.iterations),
                 flow.runs())
        .column("run", [](auto& r) { return r.first; })
        .column("largest λμ_max", {.digits = 4}, [](auto& r) { return largest_product(r.second->run); })
        .column("beyond 2 in step", [](auto& r) { return when(r.second->run.crossing_iteration); })
        .column("at vertex", [](auto& r) { return vertex_text(r.second->run.crossing_vertex); })
        .column(words.line("flow_runs.turned"), [](auto& r) { return when(r.second->turned_iteration); })
        .column("blew up in step", [](auto& r) { return when(r.second->run.blow_up_iteration); })
        .column("at vertex", {.unit = "first"}, [](auto& r) { return vertex_text(r.second->run.blow_up_vertex); })
        .column("turned at the end", {.unit = "faces", .digits = 6}, [](auto& r) { return r.second->inverted; })
        .column("last λ", {.unit = "of the first"}, [](auto& r) { return r.second->run.steps.back().lambda / r.second->lambda; })
        .column("time reached", {.unit = "% of steps × λ"},
                [](auto& r) { return 100 * r.second->run.time / (r.second->lambda * r.second->iterations); })
        .column("ended by", [](auto& r) { return end_of(r.second->run); });
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
    for (const auto& [name, watched] : flow.runs()) {
        report::Series& series = plot.series.emplace_back(report::Series{.name = name, .style = Style::line_and_points});
        for (const StepStability& step : watched->run.steps) add_point(series, double(series.x.size() + 1), step.top);
    }
    plot.series.push_back({.name = "limit 2", .x = {1, double(flow.iterations)}, .y = {2, 2}, .style = Style::dashed});
    return plot;
}

report::Map error_map(const SmoothingMaps& maps) {
    const bool known = maps.clean.has_value();
    report::Map map = plane_of(maps, "error", known ? "error.clean" : "error.input", known ? &SchemeMap::error : &SchemeMap::moved, 100,
                               readable(100 * maps.input_error));
    map.log_values = true;
    if (known) {   // what smoothing gains and what it spoils
        map.colours = report::Map::Colours::diverging;
        map.middle = 100 * maps.input_error;
        map.range = report::Map::Range{0.5 * map.middle, 2 * map.middle};
    } else {   // runs on their way out would take the scale with them
        map.range = finite_range(map.panels.back().values);
    }
    return map;
}

report::Table blow_up_table(const Planes& planes) {
    return table("stability_blow_up", words.line("blow_up", "iterations"_a = planes.front().iterations.back()), steps_beyond(planes, 4))
        .column("mesh", [](auto& r) { return r.maps.name(); })
        .column("λ/λ_crit", {.digits = 4}, [](auto& r) { return r.maps.relative(r.step); })
        .column("|1 − λμ_max|", {.unit = "a step", .digits = 4},
                [](auto& r) { return std::abs(1 - r.maps.lambdas[r.step] * r.maps.subject.top.value); })
        .column("top mode", {.unit = "iteration"}, [](auto& r) { return r.predicted(&r.maps.top); })
        .column("all modes", {.unit = "iteration"}, [](auto& r) { return r.predicted(r.maps.all ? &*r.maps.all : nullptr); })
        .column("measured", {.unit = "iteration", .digits = 6}, [](auto& r) {
            const int measured = r.maps.explicit_map.blow_up[r.step];
            return cell_of(measured, measured > 0);
        });
}

report::Table plane_table(const Planes& planes) {
    const auto value = [](PlaneValues SchemeMap::*quantity, double unit) {
        return [=](const PlaneCell& c) { return (c.map.*quantity).empty() ? report::Cell() : cell_of(unit * (c.map.*quantity)[c.i]); };
    };
    return table("stability_planes", words.line("plane"), cells_of(planes))
        .column("mesh", [](auto& c) { return c.maps.name(); })
        .column("scheme", [](auto& c) { return c.map.name(); })
        .column("λ/λ_crit", [](auto& c) { return c.maps.relative(c.maps.step_of(c.i)); })
        .column("iterations", {.digits = 5}, [](auto& c) { return c.maps.iterations[c.maps.row_of(c.i)]; })
        .column("moved (rms)", {.unit = "% of box"}, value(&SchemeMap::moved, 100))
        .column("from the clean mesh", {.unit = "% of box"}, value(&SchemeMap::error, 100))
        .column("size", {.unit = "% of input"}, value(&SchemeMap::size, 100))
        .column("smallest angle", {.unit = "°"}, value(&SchemeMap::angle, 180 / pi))
        .column("turned triangles", {.unit = "%"}, value(&SchemeMap::inverted, 100))
        .column("explicit apart", {.unit = "% of moved"}, value(&SchemeMap::apart, 100))
        .file_only();
}

report::Table region_table(const Planes& planes) {
    return table("stability_regions", words.line("regions"), scheme_rows(planes))
        .column("mesh", [](auto& r) { return r.maps.name(); })
        .column("scheme", [](auto& r) { return r.map.name(); })
        .column("cells", {.digits = 6}, [](auto& r) { return r.map.moved.size(); })
        .column("usable", {.digits = 6}, [](auto& r) { return r.usable(); })
        .column("turned", {.unit = "cells", .digits = 6}, [](auto& r) { return r.turned(); })
        .column("at most", {.unit = "% of triangles"}, [](auto& r) { return 100 * r.most_turned(); })
        .column("best error", {.unit = "% of box"}, [](auto& r) { return cell_of(100 * r.error()); })
        .column("error left", {.unit = "% of the input's"}, [](auto& r) { return cell_of(100 * r.error() / r.maps.input_error); })
        .column("at λ/λ_crit", [](auto& r) { return cell_of(r.lambda() / r.maps.subject.critical); })
        .column("iterations", {.digits = 5}, [](auto& r) { return cell_of(r.iterations()); });
}

}   // namespace meshfolio::stability
