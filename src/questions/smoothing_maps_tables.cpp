// Maps, tables and checks of the section "maps".
#include <algorithm>
#include <cmath>

#include "number_text.h"
#include "questions/section_tools.h"
#include "questions/smoothing_maps_section.h"
#include "questions/study_list.h"
#include "report/map_scale.h"

namespace meshfolio {

namespace {

// ---- maps ---------------------------------------------------------------------------------------------------------------

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
        " λ_crit = " + readable(maps.subject.critical, 4) + ". Letters: the places of " + "the pictures below.";
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
    map.caption = "Triangles of " + maps.name() + " that have turned by more than 90°: half of them is chance.";
    map.alt = map.value_label + " on " + maps.name() + ": " + ranges_of(map) + ".";
    return map;
}

// ---- tables -------------------------------------------------------------------------------------------------------------

/// Some of the steps beyond the limit, evenly through them.
std::vector<std::size_t> steps_beyond(const SmoothingMaps& maps, std::size_t most) {
    std::vector<std::size_t> beyond, chosen;
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
        if (maps.lambdas[step] > maps.subject.critical) beyond.push_back(step);
    }
    if (beyond.size() <= most) return beyond;
    for (std::size_t i = 0; i < most; ++i) chosen.push_back(beyond[i * (beyond.size() - 1) / (most - 1)]);
    return chosen;
}

int cells_with(const PlaneValues& values, double more_than) {
    return static_cast<int>(std::count_if(values.begin(), values.end(), [&](double x) { return x > more_than; }));
}
int defined_cells(const PlaneValues& values) {
    return static_cast<int>(std::count_if(values.begin(), values.end(), [](double x) { return std::isfinite(x); }));
}

}   // namespace

std::vector<report::Map> maps_of(const SmoothingMaps& maps) {
    return {error_map(maps), size_map(maps), angle_map(maps), inverted_map(maps)};
}

report::Table blow_up_table(const std::vector<SmoothingMaps>& studies) {
    report::Table table;
    table.id = "maps_blow_up";
    table.caption =
        "Steps beyond the limit, and the iteration at which a vertex is a thousand box diagonals away: as it follows from the top mode "
        "alone, from the first of all modes of a small mesh, and measured. An empty cell: not within the " +
        std::to_string(studies.front().iterations.back()) + " iterations of the plane, or not all modes known.";
    table.columns = {{"mesh", "", 3},
                     {"λ/λ_crit", "", 4},
                     {"|1 − λμ_max|", "a step", 4},
                     {"top mode", "iteration", 3},
                     {"all modes", "iteration", 3},
                     {"measured", "iteration", 6}};
    for (const SmoothingMaps& maps : studies) {
        const double last = maps.iterations.back();
        for (const std::size_t step : steps_beyond(maps, 6)) {
            const double lambda = maps.lambdas[step], top = maps.top.blow_up(lambda);
            const double all = maps.all ? maps.all->blow_up(lambda) : std::nan("");
            const int measured = maps.explicit_map.blow_up[step];
            table.rows.push_back({maps.name(), maps.relative(step), std::abs(1 - lambda * maps.subject.top.value),
                                  cell_of(top, top <= last), cell_of(all, all <= last), cell_of(measured, measured > 0)});
        }
    }
    return table;
}

report::Table place_table(const std::vector<SmoothingMaps>& studies) {
    report::Table table;
    table.id = "maps_places";
    table.caption = "The places of the pictures. Size: volume, of an open mesh area, over that of the input.";
    table.columns = {{"mesh", "", 3},
                     {"place", "", 3},
                     {"what", "", 3},
                     {"λ/λ_crit", "", 3},
                     {"iterations", "", 5},
                     {"moved (rms)", "% of box", 3},
                     {"from the clean mesh", "% of box", 3},
                     {"size", "% of input", 4},
                     {"smallest angle", "degrees", 3},
                     {"turned triangles", "%", 3}};
    for (const SmoothingMaps& maps : studies) {
        for (const MapPlace& place : maps.places) {
            const SchemeMap& map = maps.map_of(place.scheme);
            const std::size_t i = maps.index(place.step, place.row);
            table.rows.push_back({maps.name(), place.letter, place.why, maps.relative(place.step), double(maps.iterations[place.row]),
                                  cell_of(100 * map.moved[i]), map.error.empty() ? report::Cell() : cell_of(100 * map.error[i]),
                                  cell_of(100 * map.size[i]), cell_of(180 / M_PI * map.angle[i]), cell_of(100 * map.inverted[i])});
        }
    }
    return table;
}

report::Table region_table(const std::vector<SmoothingMaps>& studies) {
    report::Table table;
    table.id = "maps_regions";
    table.caption =
        "What each scheme can do over its whole plane. Usable: neither blown up nor too small to measure. Turned: usable, with at least "
        "one "
        "triangle that faces away from its first normal. Best: nearest to the mesh before its noise, where that is known.";
    table.columns = {{"mesh", "", 3},
                     {"scheme", "", 3},
                     {"cells", "", 6},
                     {"usable", "%", 3},
                     {"turned", "%", 3},
                     {"best error", "% of box", 3},
                     {"error left", "% of the input's", 3},
                     {"at λ/λ_crit", "", 3},
                     {"iterations", "", 5},
                     {"λt", "length²", 3}};
    for (const SmoothingMaps& maps : studies) {
        for (const SchemeMap* map : maps.maps()) {
            const auto best = maps.best(*map);
            const std::size_t step = best ? *best % maps.lambdas.size() : 0, row = best ? *best / maps.lambdas.size() : 0;
            const double cells = double(map->moved.size()), error = best ? map->error[*best] : std::nan("");
            table.rows.push_back({maps.name(), map->name(), cells, 100 * defined_cells(map->angle) / cells,
                                  100 * cells_with(map->inverted, 0) / cells, cell_of(100 * error), cell_of(100 * error / maps.input_error),
                                  cell_of(maps.relative(step), best.has_value()), cell_of(maps.iterations[row], best.has_value()),
                                  cell_of(maps.lambdas[step] * maps.iterations[row], best.has_value())});
        }
    }
    return table;
}

EqualTime largest_difference_at_equal_time(const SmoothingMaps& maps, const SchemeMap& map) {
    EqualTime largest;
    const std::size_t steps = maps.lambdas.size(), cells = map.moved.size();
    for (std::size_t many = 0; many < cells; ++many) {
        for (std::size_t few = 0; few < many; ++few) {
            if (maps.iterations[many / steps] != 10 * maps.iterations[few / steps]) continue;
            if (std::abs(maps.lambdas[few % steps] / maps.lambdas[many % steps] / 10 - 1) > 1e-9) continue;
            const double difference = map.moved[many] / map.moved[few] - 1;
            const bool counts = maps.lambdas[few % steps] < maps.subject.critical || &map == &maps.implicit_map;
            if (counts && std::abs(difference) > std::abs(largest.difference)) largest = {many, few, difference};
        }
    }
    return largest;
}

std::vector<report::Check> map_checks(const std::vector<SmoothingMaps>& studies) {
    std::vector<report::Check> checks;
    for (const SmoothingMaps& maps : studies) {
        const std::string on = " on " + maps.name();
        const int last = maps.iterations.back();
        int below = 0, implicit = 0, late = 0, early = 0, compared = 0;
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
            const double lambda = maps.lambdas[step];
            const int blow_up = maps.explicit_map.blow_up[step];
            implicit += maps.implicit_map.blow_up[step] > 0 ? 1 : 0;
            below += lambda < maps.subject.critical && blow_up > 0 ? 1 : 0;
            if (lambda <= maps.subject.critical) continue;
            const double latest = 1.1 * (maps.all ? *maps.all : maps.top).latest(lambda) + 1;
            late += latest < last && !(blow_up > 0 && blow_up <= latest) ? 1 : 0;
            if (!maps.all) continue;
            ++compared;
            const int earliest = maps.all->earliest(lambda, last);
            early += blow_up > 0 && (earliest == 0 || blow_up < earliest) ? 1 : 0;
        }
        checks.push_back(report::check_near("explicit runs within the limit that blew up" + on, 0, below, 0));
        checks.push_back(report::check_near("implicit runs that blew up" + on, 0, implicit, 0));
        checks.push_back(
            report::check_near("runs that outlived what a growing mode allows" + on, 0, late, 0, "by more than a tenth and one iteration"));
        if (compared > 0) checks.push_back(report::check_near("runs that blew up before all modes together could" + on, 0, early, 0));
        checks.push_back(report::check_near("factorisations a step λ of the implicit plane" + on, 1,
                                            double(maps.implicit_map.factorisations) / double(maps.lambdas.size()), 0));
    }
    return checks;
}

}   // namespace meshfolio
