// The maps of the section "maps".
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/maps/parts.h"
#include "report/svg/map_scale.h"

namespace meshfolio::maps {

namespace {

report::Series limit_line(const report::Map& map) {
    const auto edges = report::cell_edges(map.y, map.log_y);
    return {"λ_crit", {1, 1}, {edges.front(), edges.back()}, {}, {}, report::Series::Style::line};
}

/// The predicted iterations of blowing up within the plane.
report::Series predicted_line(const SmoothingMaps& maps, const GrowingModes& modes, const std::string& name, report::Series::Style style) {
    report::Series line{name, {}, {}, {}, {}, style};
    const double first = 1.005, last = maps.relative(maps.lambdas.size() - 1);
    constexpr int points = 120;
    for (int i = 0; i <= points && last > first; ++i) {
        const double relative = first * std::pow(last / first, double(i) / points);
        line.x.push_back(relative);
        line.y.push_back(modes.blow_up(relative * maps.subject.critical));
    }
    return line;
}

report::Series measured_points(const SmoothingMaps& maps) {
    report::Series points{"blew up, measured", {}, {}, {}, {}, report::Series::Style::points};
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
        if (maps.explicit_map.blow_up[step] == 0) continue;
        points.x.push_back(maps.relative(step));
        points.y.push_back(maps.explicit_map.blow_up[step]);
    }
    return points;
}

/// Empty, with its axes, lines and letters.
report::Map plane_of(const SmoothingMaps& maps, const std::string& what) {
    report::Map map;
    map.id = id_of("maps", maps.name(), what);
    map.x_label = "step λ/λ_crit";
    map.y_label = "iterations t";
    map.log_x = map.log_y = true;
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) map.x.push_back(maps.relative(step));
    map.y.assign(maps.iterations.begin(), maps.iterations.end());
    map.undefined = "blown up, or too small to measure";
    using Style = report::Series::Style;
    for (const SchemeMap* scheme : maps.maps()) {
        report::Map::Panel panel{scheme->name(), {}, {limit_line(map)}};
        if (scheme == &maps.explicit_map) {
            panel.lines.push_back(predicted_line(maps, maps.top, "blow-up, predicted from the top mode", Style::dashed));
            if (maps.all) panel.lines.push_back(predicted_line(maps, *maps.all, "predicted from all modes", Style::line));
            panel.lines.push_back(measured_points(maps));
        }
        for (const MapPlace& place : maps.places) {
            if (place.scheme == scheme->scheme)
                panel.markers.push_back({maps.relative(place.step), double(maps.iterations[place.row]), place.letter});
        }
        map.panels.push_back(std::move(panel));
    }
    return map;
}

void fill(report::Map& map, const SmoothingMaps& maps, PlaneValues SchemeMap::*quantity, double unit) {
    for (std::size_t p = 0; p < map.panels.size(); ++p) {
        for (const double value : maps.maps()[p]->*quantity) map.panels[p].values.push_back(unit * value);
    }
}

/// "explicit from 0.1 to 3, implicit from 0.1 to 50" of what is defined.
std::string ranges_of(const report::Map& map) {
    std::vector<std::string> parts;
    for (const report::Map::Panel& panel : map.panels) {
        const ValueSummary s = summary_of(Eigen::Map<const Vector>(panel.values.data(), Eigen::Index(panel.values.size())));
        parts.push_back(panel.title + (s.count == 0 ? " nowhere defined"
                                                    : " from " + readable(s.minimum) + " to " + readable(s.maximum) +
                                                          (s.undefined > 0 ? ", " + counted(s.undefined, "cell") + " undefined" : "")));
    }
    return listed(parts);
}

/// Of the positive finite values; empty where there are none.
std::optional<report::Map::Range> finite_range(const PlaneValues& values) {
    report::Map::Range range{INFINITY, 0};
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
    report::Map map = plane_of(maps, "error");
    map.value_label = known ? "rms distance from the clean mesh [% of box diagonal]" : "rms distance from the input [% of box diagonal]";
    map.log_values = true;
    fill(map, maps, known ? &SchemeMap::error : &SchemeMap::moved, 100);
    if (known) {   // what smoothing gains and what it spoils
        map.colours = report::Map::Colours::diverging;
        map.middle = 100 * maps.input_error;
        map.range = report::Map::Range{0.5 * map.middle, 2 * map.middle};
    } else {   // runs on their way out would take the scale with them
        map.range = finite_range(map.panels.back().values);
    }
    map.caption =
        "Error on " + maps.name() + " over step and iterations: " +
        (known ? "rms distance of every vertex from where it was before the noise, which the program added itself; the input is " +
                     readable(100 * maps.input_error) + " % away. Blue: nearer than the input; red: farther."
               : std::string("rms distance from the input, which is all there is to compare with.")) +
        " λ_crit = " + readable(maps.subject.critical, 4) + ". Places with a picture of their own:" + words_of(maps.places);
    map.alt = map.value_label + " on " + maps.name() + ": " + ranges_of(map) + ".";
    return map;
}

report::Map size_map(const SmoothingMaps& maps) {
    report::Map map = plane_of(maps, "size");
    const std::string what = maps.closed ? "volume" : "area";
    map.value_label = what + " over that of the input";
    map.colours = report::Map::Colours::diverging;
    map.middle = 1;
    map.range = report::Map::Range{0, 2};
    fill(map, maps, &SchemeMap::size, 1);
    map.caption = (maps.closed ? "Volume of " : "Area of ") + maps.name() + " over that of the input" +
                  (maps.closed ? "" : " (an open surface has no volume)") + ": blue where it shrinks, red where it grows.";
    map.alt = map.value_label + " on " + maps.name() + ": " + ranges_of(map) + ".";
    return map;
}

report::Map angle_map(const SmoothingMaps& maps) {
    report::Map map = plane_of(maps, "angle");
    map.value_label = "smallest angle of all triangles [degrees]";
    map.range = report::Map::Range{0, 60};
    fill(map, maps, &SchemeMap::angle, 180 / M_PI);
    const ValueSummary all = summary_of(Eigen::Map<const Vector>(map.panels[0].values.data(), Eigen::Index(map.panels[0].values.size())));
    if (all.count > 0 && all.maximum < 20) map.range->high = 20;
    map.caption = "Smallest angle on " + maps.name() + ", of all triangles; that of the input is " +
                  readable(180 / M_PI * smallest_angle(maps.subject.mesh())) + "°.";
    map.alt = map.value_label + " on " + maps.name() + ": " + ranges_of(map) + ".";
    return map;
}

report::Map inverted_map(const SmoothingMaps& maps) {
    report::Map map = plane_of(maps, "inverted");
    map.value_label = "triangles that face away from their first normals [%]";
    map.range = report::Map::Range{0, 50};
    fill(map, maps, &SchemeMap::inverted, 100);
    map.caption = "Triangles of " + maps.name() + " that have turned by more than 90°: 50 % is what chance would do.";
    map.alt = map.value_label + " on " + maps.name() + ": " + ranges_of(map) + ".";
    return map;
}

}   // namespace

std::string words_of(const std::vector<MapPlace>& places) {
    std::string words;
    for (const MapPlace& place : places) words += " " + place.letter + ": " + place.why + ".";
    return words;
}

std::vector<report::Map> maps_of(const SmoothingMaps& maps) {
    return {error_map(maps), size_map(maps), angle_map(maps), inverted_map(maps)};
}

}   // namespace meshfolio::maps
