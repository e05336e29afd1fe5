#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

std::string at_most(double x) { return readable(rounded_up(x, 2), 2); }

void append(report::Facts& facts, report::Facts more) { std::ranges::move(more, std::back_inserter(facts)); }

// ---- the limit

report::Facts proof_facts(const Studies& studies) {
    double widest = 0;
    int refuted = 0, limits = 0, semidefinite = 0;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            const StabilityCertificate& c = limit->certificate;
            widest = std::max(widest, c.relative_width());
            refuted += c.refuted() ? 1 : 0;
            semidefinite += c.bottom.semidefinite() ? 1 : 0;
            ++limits;
        }
    }
    return {"limits"_a = limits,         "both"_a = limits == 2, "semidefinite"_a = semidefinite, "proved"_a = semidefinite == limits,
            "width"_a = at_most(widest), "refuted"_a = refuted};
}

/// What makes the limiting vertex fast: its rate is weights over area, and each takes its part of it on a logarithmic scale.
enum class Cause { whole, boundary, usual, area, weights, both };
Cause cause_of(const StabilityStudy& study) {
    const LimitingVertex& v = study.limiting;
    if (!(study.cotangent.certificate.top.support < 0.1 * study.mesh().vertex_count())) return Cause::whole;
    if (v.on_boundary && v.area_share < 0.8) return Cause::boundary;
    if (v.rate() < 1.5) return Cause::usual;
    const double by_area = -std::log(v.area_share) / std::log(v.rate());
    return by_area > 0.75 ? Cause::area : by_area < 0.25 ? Cause::weights : Cause::both;
}

report::Facts cause_facts(const Studies& studies) {
    const auto meshes = [&](Cause cause) { return listed(names_where(studies, [=](auto& study) { return cause_of(study) == cause; })); };
    return {"whole"_a = meshes(Cause::whole), "boundary"_a = meshes(Cause::boundary), "usual"_a = meshes(Cause::usual),
            "area"_a = meshes(Cause::area),   "weights"_a = meshes(Cause::weights),   "area_and_weights"_a = meshes(Cause::both)};
}

report::Facts side_facts(const Studies& studies) {
    double off = 0, highest = 0;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            off = std::max(off, std::abs(over_predicted(limit->beyond) - 1));
            highest = std::max(highest, limit->below.factor.back());
        }
    }
    const auto range = [&](int digits, const auto& value) {
        const auto [low, high] = std::ranges::minmax_element(studies, {}, value);
        return span_of(readable(value(*low), digits), readable(value(*high), digits));
    };
    const ModeGrowth& beyond = studies.front().cotangent.beyond;
    return {"steps"_a = beyond.steps(),
            "growth"_a = readable(beyond.predicted(beyond.steps()), 2),
            "off"_a = at_most(off),
            "left"_a = at_most(highest),
            "uniform"_a = range(3, [](const StabilityStudy& s) { return s.uniform.critical(); }),
            "cotangent"_a = range(2, [](const StabilityStudy& s) { return s.cotangent.critical() / (s.mean_edge * s.mean_edge); })};
}

// ---- the rebuilt flow

/// "Face 12 is the first to turn over, in step 4. …": what went wrong in a run, in the order in which it is looked at.
report::Text diagnosis(const WatchedRun& watched) {
    const Smoothed& run = watched.run;
    return words.say("run", "turned"_a = watched.turned_iteration, "face"_a = watched.turned_face, "blew_up"_a = run.blow_up_iteration,
                     "vertex"_a = run.blow_up_vertex, "diagonals"_a = readable(SmoothingOptions().blow_up_at),
                     "collapsed"_a = run.collapse_iteration > 0, "steps"_a = run.iterations);
}

report::Facts flow_facts(const RebuiltFlow& flow) {
    const Smoothed &fixed = flow.fixed.run, &adaptive = flow.adaptive.run, &frozen = flow.frozen.run;
    const auto share = [&](const WatchedRun& run) { return readable_percent(double(run.inverted) / flow.source->mesh().face_count(), 1); };
    return {"flow_mesh"_a = flow.name(),
            "crosses"_a = fixed.crossing_iteration,
            "largest"_a = readable(largest_product(fixed), 3),
            "fixed_run"_a = diagnosis(flow.fixed),
            "survives"_a = fixed.crossing_iteration > 0 && !fixed.blew_up && fixed.collapse_iteration == 0,
            "share"_a = readable(flow.share, 3),
            "adaptive_crosses"_a = adaptive.crossing_iteration,
            "adaptive_run"_a = diagnosis(flow.adaptive),
            "time"_a = readable_percent(adaptive.time / (flow.lambda * flow.iterations), 2),
            "shrinks"_a = adaptive.steps.back().lambda < 0.5 * flow.lambda,
            "turned"_a = flow.fixed.inverted + flow.adaptive.inverted,
            "fixed_turned"_a = share(flow.fixed),
            "adaptive_turned"_a = share(flow.adaptive),
            "times"_a = readable(flow.beyond, 1),
            "frozen_factor"_a = readable(frozen.steps.front().top - 1, 2),
            "frozen_run"_a = diagnosis(flow.frozen),
            "frozen_survives"_a = frozen.blew_up ? 0 : frozen.iterations};
}

// ---- the planes

/// How many runs of the planes lie on either side of the explicit limit, and how many of them blew up.
struct BlowUps {
    int within = 0, beyond = 0, within_lost = 0, beyond_lost = 0, implicit_lost = 0;
    double off = 0;   // largest distance of a measured iteration from the best prediction at hand
};
BlowUps blow_ups_of(const Planes& planes) {
    BlowUps found;
    for (const SmoothingMaps& maps : planes) {
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
            const int measured = maps.explicit_map.blow_up[step], lost = measured > 0 ? 1 : 0;
            const bool stable = maps.lambdas[step] <= maps.subject.critical;
            (stable ? found.within : found.beyond) += 1;
            (stable ? found.within_lost : found.beyond_lost) += lost;
            found.implicit_lost += maps.implicit_map.blow_up[step] > 0 ? 1 : 0;
            const double predicted = maps.known_modes().blow_up(maps.lambdas[step]);
            if (lost > 0 && predicted > 0) found.off = std::max(found.off, std::abs(measured - std::ceil(predicted)));
        }
    }
    return found;
}

report::Facts blow_up_facts(const Planes& planes) {
    const BlowUps found = blow_ups_of(planes);
    const auto is_hidden = [](const SmoothingMaps& maps) { return maps.top.heights[0] <= 1e4 * maps.top.rounding; };
    return {"faults"_a = found.within_lost + found.implicit_lost,
            "within"_a = found.within,
            "beyond"_a = found.beyond,
            "lost"_a = found.beyond_lost,
            "all_lost"_a = found.beyond > 0 && found.beyond_lost == found.beyond,
            "late"_a = std::lround(found.off),
            "plane_mesh"_a = planes.front().name(),
            "hidden"_a = listed(names_where(planes, is_hidden)),
            "hidden_known"_a = std::ranges::all_of(planes, [&](auto& maps) { return !is_hidden(maps) || maps.all; })};
}

report::Facts gap_facts(const Planes& planes) {
    const Gap gap = largest_gap(planes);
    const SmoothingMaps& maps = gap.maps ? *gap.maps : planes.front();
    double at_equal_time = 0;
    for (const SmoothingMaps& each : planes)
        at_equal_time = std::max(at_equal_time, std::abs(largest_difference_at_equal_time(each, each.implicit_map).difference));
    return {"gap"_a = gap.maps ? readable_percent(rounded_up(gap.apart, 2), 2) : "", "gap_mesh"_a = maps.name(),
            "gap_t"_a = maps.iterations[maps.row_of(gap.cell)],
            "gap_fades"_a = gap.last<0.5 * gap.apart, "gap_last"_a = readable_percent(rounded_up(gap.last, 2), 2),
                                     "last_t"_a = maps.iterations.back(), "equal_time"_a = at_equal_time> 0
                                ? readable_percent(rounded_up(at_equal_time, 2), 2)
                                : ""};
}

/// Which scheme comes nearest to the clean mesh, by more than 2 %.
enum class Nearest { unknown, neither, explicit_steps, implicit_steps, both };
Nearest nearest(const SmoothingMaps& maps) {
    const auto by_explicit = maps.best(maps.explicit_map), by_implicit = maps.best(maps.implicit_map);
    if (!by_explicit || !by_implicit) return Nearest::unknown;
    const double e = maps.explicit_map.error[*by_explicit], i = maps.implicit_map.error[*by_implicit];
    if (std::min(e, i) >= maps.input_error) return Nearest::neither;
    return i < 0.98 * e ? Nearest::implicit_steps : e < 0.98 * i ? Nearest::explicit_steps : Nearest::both;
}

report::Facts result_facts(const Planes& planes) {
    const auto named = [&](Nearest which) { return listed(names_where(planes, [=](auto& maps) { return nearest(maps) == which; })); };
    const auto turned = [&](SchemeMap SmoothingMaps::*map) {
        return listed(
            names_where(planes, [=](auto& maps) { return std::ranges::any_of((maps.*map).inverted, [](double x) { return x > 0; }); }));
    };
    double least = infinity;
    std::string least_mesh;
    for (const SmoothingMaps& maps : planes)
        for (const double size : maps.implicit_map.size)
            if (size < least) least = size, least_mesh = maps.name();   // NaN is left out
    return {"neither"_a = named(Nearest::neither),
            "by_explicit"_a = named(Nearest::explicit_steps),
            "by_implicit"_a = named(Nearest::implicit_steps),
            "by_both"_a = named(Nearest::both),
            "turned_explicit"_a = turned(&SmoothingMaps::explicit_map),
            "turned_implicit"_a = turned(&SmoothingMaps::implicit_map),
            "least_mesh"_a = least_mesh,
            "least"_a = least < 1e-6 ? "" : readable_percent(least, 2)};
}

}   // namespace

Gap largest_gap(const Planes& planes) {
    Gap gap;
    for (const SmoothingMaps& maps : planes) {
        const PlaneValues& apart = maps.implicit_map.apart;
        for (std::size_t i = 0; i < apart.size(); ++i) {
            if (apart[i] > gap.apart) gap.maps = &maps, gap.cell = i, gap.apart = apart[i];
            if (maps.row_of(i) + 1 == maps.iterations.size() && apart[i] > gap.last) gap.last = apart[i];
        }
    }
    return gap;
}

report::Facts facts_of(const Studies& studies, const RebuiltFlow& flow, const Planes& planes) {
    report::Facts facts = proof_facts(studies);
    for (const auto of_limit : {cause_facts, side_facts}) append(facts, of_limit(studies));
    append(facts, flow_facts(flow));
    for (const auto of_planes : {blow_up_facts, gap_facts, result_facts}) append(facts, of_planes(planes));
    facts.push_back("growth_mesh"_a = studies.back().name());
    return facts;
}

}   // namespace meshfolio::stability
