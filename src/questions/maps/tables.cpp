// Tables of the section "maps".
#include "questions/maps/parts.h"

namespace meshfolio::maps {

namespace {

struct StepRow {
    const SmoothingMaps& maps;
    std::size_t step;

    /// Where it lies within the plane.
    report::Cell predicted(const GrowingModes* modes) const {
        const double iteration = modes ? modes->blow_up(maps.lambdas[step]) : undefined;
        return cell_of(iteration, iteration <= maps.iterations.back());
    }
};

/// Some of the steps beyond the limit, evenly through them.
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
    /// Of the cells of the plane for which something holds. [%]
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

}   // namespace meshfolio::maps
