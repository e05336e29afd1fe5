// Tables and checks of the section "maps".
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/maps/parts.h"

namespace meshfolio::maps {

namespace {

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

report::Table blow_up_table(const std::vector<SmoothingMaps>& studies) {
    report::Table table;
    table.id = "maps_blow_up";
    table.caption =
        "Steps beyond the limit, and the iteration at which a vertex is a thousand box diagonals away: as it follows from the top mode "
        "alone, from the first of all modes of a small mesh, and measured. –: not within the " +
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

}   // namespace meshfolio::maps
