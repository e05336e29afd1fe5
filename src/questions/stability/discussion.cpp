#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

std::string at_most(double x) { return readable(rounded_up(x, 2), 2); }
std::string percent_at_most(double x) { return readable_percent(rounded_up(x, 2), 2); }

report::Facts list_of(auto... facts) { return {std::move(facts)...}; }

report::Facts limit_facts(const Studies& studies) {
    int limits = 0, semidefinite = 0, refuted = 0;
    double widest = 0, off = 0, highest = 0;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit& limit : study.limits) {
            ++limits;
            semidefinite += limit.certificate.bottom.semidefinite() ? 1 : 0;
            refuted += limit.certificate.refuted() ? 1 : 0;
            widest = std::max(widest, limit.certificate.relative_width());
            off = std::max(off, std::abs(measured_over_predicted(limit.beyond) - 1));
            highest = std::max(highest, limit.below.factor.back());
        }
    }
    const auto range = [&](int digits, const auto& value) {
        const auto [low, high] = std::ranges::minmax(each_of(studies, value));
        return span_of(readable(low, digits), readable(high, digits));
    };
    const ModeGrowth& beyond = studies.front().cotangent().beyond;
    return list_of(
        "limits"_a = limits, "both"_a = limits == 2, "semidefinite"_a = semidefinite, "proved"_a = semidefinite == limits,
        "width"_a = at_most(widest), "refuted"_a = refuted, "steps"_a = beyond.steps(), "growth_mesh"_a = studies.back().name(),
        "growth"_a = readable(beyond.predicted(beyond.steps()), 2), "off"_a = at_most(off), "left"_a = at_most(highest),
        "uniform"_a = range(3, [](const StabilityStudy& s) { return s.uniform().critical(); }),
        "cotangent"_a = range(2, [](const StabilityStudy& s) { return s.cotangent().critical() / (s.mean_edge * s.mean_edge); }));
}

/// Returns the name of the fact that says why the limiting vertex is fast: by its weights, its area or both, compared in logarithms.
std::string_view cause_of(const StabilityStudy& study) {
    const LimitingVertex& v = study.limiting;
    if (!(study.cotangent().certificate.top.support < 0.1 * study.mesh().vertex_count())) return "whole";
    if (v.on_boundary && v.area_share < 0.8) return "boundary";
    if (v.rate() < 1.5) return "usual";
    const double by_area = -std::log(v.area_share) / std::log(v.rate());
    return by_area > 0.75 ? "area" : by_area < 0.25 ? "weights" : "area_and_weights";
}

/// Returns how a run went wrong: "Face 12 is the first to turn over, in step 4. …"
report::Text diagnosis(const WatchedRun& watched) {
    const Smoothed& run = watched.run;
    return words.say("run", "turned"_a = watched.turned_iteration, "face"_a = watched.turned_face, "blew_up"_a = run.blow_up_iteration,
                     "vertex"_a = run.blow_up_vertex, "diagonals"_a = readable(SmoothingOptions().blow_up_at),
                     "collapsed"_a = run.collapse_iteration > 0, "steps"_a = run.iterations);
}

report::Facts flow_facts(const RebuiltFlow& flow) {
    const Smoothed &fixed = flow.fixed.run, &adaptive = flow.adaptive.run, &frozen = flow.frozen.run;
    const auto share = [&](const WatchedRun& run) { return readable_percent(double(run.inverted) / flow.mesh().face_count(), 1); };
    return list_of(
        "flow_mesh"_a = flow.name(), "crosses"_a = fixed.crossing_iteration, "largest"_a = readable(largest_product(fixed), 3),
        "fixed_run"_a = diagnosis(flow.fixed),
        "survives"_a = fixed.crossing_iteration > 0 && !fixed.blew_up && fixed.collapse_iteration == 0, "share"_a = readable(flow.share, 3),
        "adaptive_crosses"_a = adaptive.crossing_iteration, "adaptive_run"_a = diagnosis(flow.adaptive),
        "time"_a = readable_percent(adaptive.time / (flow.fixed.lambda * flow.fixed.iterations), 2),
        "shrinks"_a = adaptive.steps.back().lambda < 0.5 * flow.fixed.lambda, "turned"_a = flow.fixed.inverted + flow.adaptive.inverted,
        "fixed_turned"_a = share(flow.fixed), "adaptive_turned"_a = share(flow.adaptive), "times"_a = readable(flow.beyond, 1),
        "frozen_factor"_a = readable(frozen.steps.front().top - 1, 2), "frozen_run"_a = diagnosis(flow.frozen),
        "frozen_survives"_a = frozen.blew_up ? 0 : frozen.iterations);
}

report::Facts run_facts(const Planes& planes) {
    const BlowUps found = blow_ups_of(planes);
    const auto is_hidden = [](const SmoothingMaps& maps) { return maps.top.heights[0] <= maps.top.noticeable(); };
    const Gap gap = largest_gap(planes);
    const SmoothingMaps& maps = gap.maps ? *gap.maps : planes.front();
    const double at_equal_time = largest_of(planes, largest_difference_at_equal_time);
    return list_of("faults"_a = found.within_lost + found.implicit_lost, "beyond"_a = found.beyond, "lost"_a = found.beyond_lost,
                   "all_lost"_a = found.beyond > 0 && found.beyond_lost == found.beyond, "late"_a = std::lround(found.off),
                   "plane_mesh"_a = planes.front().name(), "hidden"_a = listed(names_where(planes, is_hidden)),
                   "hidden_known"_a = std::ranges::all_of(planes, [&](auto& m) { return !is_hidden(m) || m.all; }),
                   "gap"_a = gap.maps ? percent_at_most(gap.largest) : "", "gap_mesh"_a = maps.name(),
                   "gap_t"_a = maps.iterations[maps.row_of(gap.cell)], "gap_fades"_a = (gap.last < 0.5 * gap.largest),
                   "gap_last"_a = percent_at_most(gap.last), "last_t"_a = maps.iterations.back(),
                   "equal_time"_a = (at_equal_time > 0) ? percent_at_most(at_equal_time) : "");
}

/// Returns the name of the fact that says which scheme comes nearest to the clean mesh, by more than 2 %; empty if no clean mesh is known.
std::string_view nearest(const SmoothingMaps& maps) {
    const auto by_explicit = maps.best(maps.explicit_map()), by_implicit = maps.best(maps.implicit_map());
    if (!by_explicit || !by_implicit) return "";
    const double e = maps.explicit_map().error[*by_explicit], i = maps.implicit_map().error[*by_implicit];
    if (std::min(e, i) >= maps.input_error) return "neither";
    return i < 0.98 * e ? "by_implicit" : e < 0.98 * i ? "by_explicit" : "by_both";
}

report::Facts result_facts(const Planes& planes) {
    const auto turned = [&](const SchemeMap& (SmoothingMaps::*map)() const) {
        const auto turns = [=](const SmoothingMaps& maps) { return largest_of((maps.*map)().inverted, std::identity()) > 0; };
        return listed(names_where(planes, turns));
    };
    double least = infinity;
    std::string least_mesh;
    for (const SmoothingMaps& maps : planes)
        for (const double size : maps.implicit_map().size)
            if (size < least) least = size, least_mesh = maps.name();   // NaN is left out
    report::Facts facts =
        list_of("turned_explicit"_a = turned(&SmoothingMaps::explicit_map), "turned_implicit"_a = turned(&SmoothingMaps::implicit_map),
                "least_mesh"_a = least_mesh, "least"_a = least < 1e-6 ? "" : readable_percent(least, 2));
    for (const std::string_view fact : {"neither", "by_explicit", "by_implicit", "by_both"})
        facts.emplace_back(fact, listed(names_where(planes, [=](auto& maps) { return nearest(maps) == fact; })));
    return facts;
}

}   // namespace

BlowUps blow_ups_of(std::span<const SmoothingMaps> planes) {
    BlowUps found;
    for (const SmoothingMaps& maps : planes) {
        const int last = maps.iterations.back();
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
            const double lambda = maps.lambdas[step], predicted = maps.known_modes().blow_up(lambda);
            const int blow_up = maps.explicit_map().blow_up[step], lost = blow_up > 0 ? 1 : 0;
            found.implicit_lost += maps.implicit_map().blow_up[step] > 0 ? 1 : 0;
            if (lost > 0 && predicted > 0) found.off = std::max(found.off, std::abs(blow_up - std::ceil(predicted)));
            if (lambda <= maps.subject.critical) {
                found.within_lost += lost;
                continue;
            }
            ++found.beyond;
            found.beyond_lost += lost;
            const double latest = 1.1 * maps.known_modes().blow_up(lambda, maps.known_modes().noticeable()) + 1;
            found.late += latest < last && !(lost > 0 && blow_up <= latest) ? 1 : 0;
            const int earliest = maps.all ? maps.all->earliest(lambda, last) : 1;
            found.early += lost > 0 && (earliest == 0 || blow_up < earliest) ? 1 : 0;
        }
    }
    return found;
}

Gap largest_gap(const Planes& planes) {
    Gap gap;
    for (const SmoothingMaps& maps : planes) {
        const PlaneValues& gaps = maps.implicit_map().gap;
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            if (gaps[i] > gap.largest) gap.maps = &maps, gap.cell = i, gap.largest = gaps[i];
            if (maps.row_of(i) + 1 == maps.iterations.size() && gaps[i] > gap.last) gap.last = gaps[i];
        }
    }
    return gap;
}

report::Facts facts_of(const Studies& studies, const RebuiltFlow& flow, const Planes& planes) {
    report::Facts facts = limit_facts(studies);
    for (const std::string_view cause : {"whole", "boundary", "usual", "area", "weights", "area_and_weights"})
        facts.emplace_back(cause, listed(names_where(studies, [=](auto& study) { return cause_of(study) == cause; })));
    for (report::Facts more : {flow_facts(flow), run_facts(planes), result_facts(planes)})
        std::ranges::move(more, std::back_inserter(facts));
    return facts;
}

}   // namespace meshfolio::stability
