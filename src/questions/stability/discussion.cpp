// The checks of the section "stability", its record, and the facts that its words choose from.
#include <span>

#include "questions/stability/study.h"

namespace meshfolio::stability {

namespace {

/// Returns the growth of the mode over the whole run, measured over predicted; 1 if the run obeys the law.
double measured_over_predicted(const ModeGrowth& growth) { return growth.factor.back() / growth.predicted(growth.steps()); }

/// Counts of runs that blew up, over some planes.
struct BlowUps {
    int beyond = 0;                                            // explicit runs beyond the limit
    int within_lost = 0, beyond_lost = 0, implicit_lost = 0;   // blew up: explicit within the limit, beyond it, implicit
    int late = 0;     // lasted longer than a growing mode allows, by more than a tenth and one iteration
    int early = 0;    // blew up before all modes together could
    double off = 0;   // largest distance of a measured iteration from the predicted one
};
BlowUps blow_ups_of(std::span<const SmoothingMaps> planes) {
    BlowUps found;
    for (const SmoothingMaps& maps : planes) {
        const int last = maps.iterations.back();
        const GrowingModes& known = maps.all ? *maps.all : maps.top;
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
            const double lambda = maps.lambdas[step], predicted = known.blow_up(lambda);
            const int blow_up = maps.explicit_map().blow_up[step], lost = blow_up > 0 ? 1 : 0;
            found.implicit_lost += maps.implicit_map().blow_up[step] > 0 ? 1 : 0;
            if (lost > 0 && predicted > 0) found.off = std::max(found.off, std::abs(blow_up - std::ceil(predicted)));
            if (lambda <= maps.subject.critical) {
                found.within_lost += lost;
                continue;
            }
            ++found.beyond;
            found.beyond_lost += lost;
            const double latest = 1.1 * known.blow_up(lambda, known.noticeable()) + 1;
            found.late += latest < last && !(lost > 0 && blow_up <= latest) ? 1 : 0;
            const int earliest = maps.all ? maps.all->earliest(lambda, last) : 1;
            found.early += lost > 0 && (earliest == 0 || blow_up < earliest) ? 1 : 0;
        }
    }
    return found;
}

/// Checks the proof of one limit, and the runs on either side of it.
void add_limit_checks(report::Section& section, const std::string& mesh, const OperatorLimit& limit) {
    const auto name = [&](std::string_view key) { return words.line(key, "operator"_a = limit.name, "mesh"_a = mesh); };
    const StabilityCertificate& proved = limit.certificate;
    constexpr double wanted = 1e-8;
    report::Check width = check_at_most(name("check.width"), wanted, proved.relative_width());
    if (!width.passed() && proved.rounding >= 0.2 * wanted)   // of a large factor
        width = undecided(std::move(width), words.line("check.width.undecided", "entries"_a = proved.factor_nonzeros));

    const Definiteness& bottom = proved.bottom;
    const double lowest = bottom.indefinite() ? bottom.mu_high : bottom.mu_low;
    report::Check semidefinite = check_at_least(name("check.semidefinite"), 0, lowest / proved.mu_high, 1e-10);
    if (!bottom.semidefinite() && !bottom.indefinite())
        semidefinite = undecided(std::move(semidefinite), words.line("check.semidefinite.undecided", "low"_a = readable(bottom.mu_low, 2),
                                                                     "high"_a = readable(bottom.mu_high, 2)));

    const ModeGrowth& below = limit.below;
    append_checks(section, {width, semidefinite, check_at_least(name("check.gershgorin"), 1, proved.top.upper_bound / proved.mu_high, 1e-8),
                            check_near(name("check.growth"), 1, measured_over_predicted(limit.beyond), 1e-3),
                            check_at_most(name("check.decay"), 1, *std::max_element(below.factor.begin() + 1, below.factor.end())),
                            check_at_most(name("check.decay_by_law"), 0, below.factor.back() - below.predicted(below.steps()), 1e-6)});
}

std::string at_most(double x) { return readable(rounded_up(x, 2), 2); }

report::Facts limit_facts(const Studies& studies) {
    int semidefinite = 0, refuted = 0;
    const int limits = 2 * static_cast<int>(studies.size());
    double widest = 0, off = 0, highest = 0;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit& limit : study.limits) {
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
    const double rate = v.stiffness_share / v.area_share;   // of its motion, over that of a median vertex
    if (rate < 1.5) return "usual";
    const double by_area = -std::log(v.area_share) / std::log(rate);
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
    return list_of("faults"_a = found.within_lost + found.implicit_lost, "beyond"_a = found.beyond, "lost"_a = found.beyond_lost,
                   "all_lost"_a = found.beyond > 0 && found.beyond_lost == found.beyond, "late"_a = std::lround(found.off),
                   "plane_mesh"_a = planes.front().name(), "hidden"_a = listed(names_where(planes, is_hidden)),
                   "hidden_known"_a = std::ranges::all_of(planes, [&](auto& m) { return !is_hidden(m) || m.all; }));
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
    const auto turned = [&](std::size_t scheme) {
        return listed(names_where(planes, [=](auto& maps) { return largest_of(maps.schemes[scheme].inverted, std::identity()) > 0; }));
    };
    double least = infinity;
    std::string least_mesh;
    for (const SmoothingMaps& maps : planes)
        for (const double size : maps.implicit_map().size)
            if (size < least) least = size, least_mesh = maps.name();   // NaN is left out
    report::Facts facts = list_of("turned_explicit"_a = turned(0), "turned_implicit"_a = turned(1), "least_mesh"_a = least_mesh,
                                  "least"_a = least < 1e-6 ? "" : readable_percent(least, 2));
    for (const std::string_view fact : {"neither", "by_explicit", "by_implicit", "by_both"})
        facts.emplace_back(fact, listed(names_where(planes, [=](auto& maps) { return nearest(maps) == fact; })));
    return facts;
}

}   // namespace

void add_checks(report::Section& section, const Studies& studies, const RebuiltFlow& flow, const Planes& planes) {
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit& limit : study.limits) add_limit_checks(section, study.name(), limit);
        const double mu_low = study.uniform().certificate.mu_low;
        add(section, check_at_most(words.line("check.uniform", "mesh"_a = study.name()), 2, mu_low));
    }
    add(section, check_at_most(words.line("check.adaptive", "mesh"_a = flow.name()), 2, largest_product(flow.adaptive.run)));
    for (const SmoothingMaps& maps : planes) {
        const BlowUps found = blow_ups_of({&maps, 1});
        const auto none = [&](std::string_view key, int runs, const std::string& note = "") {
            return check_near(words.line(key, "mesh"_a = maps.name()), 0, runs, 0, note);
        };
        append_checks(section, {none("check.explicit", found.within_lost), none("check.implicit", found.implicit_lost),
                                none("check.late", found.late, words.line("check.late.note"))});
        if (maps.all && found.beyond > 0) add(section, none("check.early", found.early));
        add(section, check_near(words.line("check.factorisations", "mesh"_a = maps.name()), 1,
                                double(maps.implicit_map().factorisations) / double(maps.lambdas.size()), 0));
    }
}

void add_record(report::Section& section, const Studies& studies, const Planes& planes) {
    for (const StabilityStudy& study : studies) {
        const double critical = study.cotangent().critical();
        section.parameters[words.line("parameter.critical", "mesh"_a = study.name())] = {plain_text(critical, 10), critical, "length²"};
    }
    section.parameters[words.line("parameter.steps")] = studies.front().cotangent().beyond.steps();
    section.parameters["operator"] = words.line("parameter.operators");
    for (const SmoothingMaps& maps : planes) {
        const auto relative = each_of(maps.lambdas, [&](double lambda) { return lambda / maps.subject.critical; });
        section.parameters[words.line("parameter.plane", "mesh"_a = maps.name())] = {
            words.line("parameter.plane.value", "steps"_a = relative.size(), "first"_a = readable(relative.front()),
                       "last"_a = readable(relative.back()), "iterations"_a = maps.iterations.back()),
            relative};
    }
    section.extent = words.line("extent", "meshes"_a = listed(names_of(studies)), "planes"_a = listed(names_of(planes)));
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
