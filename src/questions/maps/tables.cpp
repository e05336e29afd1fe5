#include "questions/maps/parts.h"
#include "report/svg/map_scale.h"

namespace meshfolio::maps {

namespace {

using Style = report::Series::Style;

ValueSummary summary_of_plane(const PlaneValues& values) {
    return summary_of(Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size())));
}

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
        const ValueSummary s = summary_of_plane(panel.values);
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
    report::Map map{.id = id_of("maps", maps.name(), id),
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
std::vector<StepRow> steps_beyond(const Studies& studies, std::size_t most) {
    std::vector<StepRow> rows;
    for (const SmoothingMaps& maps : studies) {
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
    /// The share of the plane's cells for which `holds` is true. [%]
    double share(const PlaneValues& values, bool (*holds)(double)) const {
        return 100 * double(std::ranges::count_if(values, holds)) / double(map.moved.size());
    }
};
std::vector<SchemeRow> scheme_rows(const Studies& studies) {
    std::vector<SchemeRow> rows;
    for (const SmoothingMaps& maps : studies)
        for (const SchemeMap* map : maps.maps()) rows.push_back({maps, *map});
    return rows;
}

}   // namespace

report::Table blow_up_table(const Studies& studies) {
    return table("maps_blow_up", words.line("blow_up", "iterations"_a = studies.front().iterations.back()), steps_beyond(studies, 6))
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

report::Table place_table(const Studies& studies) {
    const auto value = [](PlaneValues SchemeMap::*quantity, double unit) {
        return [=](const Within<SmoothingMaps, MapPlace>& r) {
            const PlaneValues& values = r.whole.map_of(r.part.scheme).*quantity;
            return values.empty() ? report::Cell() : cell_of(unit * values[r.whole.index(r.part.step, r.part.row)]);
        };
    };
    return table("maps_places", words.line("places"), parts_within(studies, &SmoothingMaps::places))
        .column("mesh", [](auto& r) { return r.whole.name(); })
        .column("place", [](auto& r) { return r.part.letter; })
        .column("what", [](auto& r) { return r.part.why; })
        .column("λ/λ_crit", [](auto& r) { return r.whole.relative(r.part.step); })
        .column("iterations", {.digits = 5}, [](auto& r) { return r.whole.iterations[r.part.row]; })
        .column("moved (rms)", {.unit = "% of box"}, value(&SchemeMap::moved, 100))
        .column("from the clean mesh", {.unit = "% of box"}, value(&SchemeMap::error, 100))
        .column("size", {.unit = "% of input", .digits = 4}, value(&SchemeMap::size, 100))
        .column("smallest angle", {.unit = "degrees"}, value(&SchemeMap::angle, 180 / pi))
        .column("turned triangles", {.unit = "%"}, value(&SchemeMap::inverted, 100));
}

report::Table region_table(const Studies& studies) {
    return table("maps_regions", words.line("regions"), scheme_rows(studies))
        .column("mesh", [](auto& r) { return r.maps.name(); })
        .column("scheme", [](auto& r) { return r.map.name(); })
        .column("cells", {.digits = 6}, [](auto& r) { return r.map.moved.size(); })
        .column("usable", {.unit = "%"}, [](auto& r) { return r.share(r.map.angle, [](double x) { return std::isfinite(x); }); })
        .column("turned", {.unit = "%"}, [](auto& r) { return r.share(r.map.inverted, [](double x) { return x > 0; }); })
        .column("best error", {.unit = "% of box"}, [](auto& r) { return cell_of(100 * r.error()); })
        .column("error left", {.unit = "% of the input's"}, [](auto& r) { return cell_of(100 * r.error() / r.maps.input_error); })
        .column("at λ/λ_crit", [](auto& r) { return cell_of(r.lambda() / r.maps.subject.critical); })
        .column("iterations", {.digits = 5}, [](auto& r) { return cell_of(r.iterations()); })
        .column("λt", {.unit = "length²"}, [](auto& r) { return cell_of(r.lambda() * r.iterations()); });
}

std::string words_of(const std::vector<MapPlace>& places) {
    return joined(each_of(places, [](auto& p) { return words.line("place", "letter"_a = p.letter, "why"_a = p.why); }), " ");
}

std::vector<report::Map> maps_of(const SmoothingMaps& maps) {
    report::Map size = plane_of(maps, "size", maps.closed ? "volume" : "area", &SchemeMap::size, 1);
    size.colours = report::Map::Colours::diverging;
    size.middle = 1;
    size.range = report::Map::Range{0, 2};
    report::Map inverted = plane_of(maps, "inverted", "inverted", &SchemeMap::inverted, 100);
    inverted.range = report::Map::Range{0, 50};
    return {error_map(maps), std::move(size), std::move(inverted)};
}

}   // namespace meshfolio::maps
