#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

std::string at_most(double x) { return readable(rounded_up(x, 2), 2); }

/// Counts the proved limits of all operators on all meshes.
struct Proofs {
    double widest = 0, rounding = 0, below = 0;
    int refuted = 0, limits = 0, semidefinite = 0;

    bool all() const { return semidefinite == limits; }
    std::string named() const { return limits == 2 ? words.line("proved.both") : words.line("proved.all", "limits"_a = limits); }
};
Proofs proofs_of(const Studies& studies) {
    Proofs proofs;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            const StabilityCertificate& c = limit->certificate;
            proofs.widest = std::max(proofs.widest, c.relative_width());
            proofs.rounding = std::max(proofs.rounding, c.rounding);
            proofs.below = std::max(proofs.below, -c.bottom.mu_low / c.mu_high);
            proofs.refuted += c.refuted() ? 1 : 0;
            proofs.semidefinite += c.bottom.semidefinite() ? 1 : 0;
            ++proofs.limits;
        }
    }
    return proofs;
}

report::Text what_is_proved(const Studies& studies) {
    const Proofs proofs = proofs_of(studies);
    const std::string width = at_most(proofs.widest);
    if (!proofs.all())
        return words.say("proved.not_all", "operators"_a = proofs.limits, "semidefinite"_a = proofs.semidefinite, "width"_a = width);
    return paragraph_of(
        {words.say("proved", "limits"_a = proofs.named(), "width"_a = width, "rounding"_a = at_most(proofs.rounding)),
         proofs.refuted == 0 ? words.say("proved.at_once") : words.say("proved.after_breakdown", "cases"_a = proofs.refuted),
         words.say("proved.semidefinite", "below"_a = at_most(proofs.below))});
}

/// What makes that vertex fast: its rate is weights over area, and each takes its part of it on a logarithmic scale.
std::string why(const LimitingVertex& v) {
    const double by_area = -std::log(v.area_share) / std::log(v.rate());
    const char* key = v.on_boundary && v.area_share < 0.8 ? "vertex.boundary"
                      : v.rate() < 1.5                    ? "vertex.usual"
                      : by_area > 0.75                    ? "vertex.small_area"
                      : by_area < 0.25                    ? "vertex.large_weights"
                                                          : "vertex.both";
    return words.line(key, "rate"_a = readable(v.rate(), 2), "area"_a = readable(v.area_share, 2),
                      "weights"_a = readable(v.stiffness_share, 2));
}

report::Text where_and_why(const StabilityStudy& study) {
    const LimitingVertex& v = study.limiting;
    const int vertices = study.mesh().vertex_count();
    const double sharing = std::max(1.0, study.cotangent.certificate.top.support);
    return words.say(!(sharing < 0.1 * vertices) ? "vertex.none" : "vertex", "mesh"_a = study.name(), "vertex"_a = v.vertex,
                     "alike"_a = study.peaks.size() > 1 ? words.line("vertex.alike", "others"_a = study.peaks.size() - 1) : "",
                     "sharing"_a = readable(sharing, 2), "of_all"_a = words.line("vertex.of_all", "vertices"_a = vertices),
                     "why"_a = why(v));
}

report::Text on_both_sides(const Studies& studies) {
    double off = 0, highest = 0;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            off = std::max(off, std::abs(over_predicted(limit->beyond) - 1));
            highest = std::max(highest, limit->below.factor.back());
        }
    }
    const OperatorLimit& first = studies.front().cotangent;
    const int steps = first.beyond.steps();
    return words.say("both_sides", "steps"_a = steps, "growth"_a = readable(first.beyond.predicted(steps), 2), "off"_a = readable(off, 2),
                     "left"_a = readable(highest, 2), "predicted"_a = readable(first.below.predicted(steps), 2));
}

report::Text about_uniform(const Studies& studies) {
    const auto range = [&](int digits, const auto& value) {
        const auto [low, high] = std::ranges::minmax_element(studies, {}, value);
        return span_of(readable(value(*low), digits), readable(value(*high), digits));
    };
    return words.say(
        "uniform", "uniform"_a = range(4, [](const StabilityStudy& s) { return s.uniform.critical(); }),
        "cotangent"_a = range(2, [](const StabilityStudy& s) { return s.cotangent.critical() / (s.mean_edge * s.mean_edge); }));
}

/// "In step 4 face 12 is turned over; …": what went wrong in a run, in the order it is looked at.
report::Text diagnosis(const WatchedRun& watched) {
    const Smoothed& run = watched.run;
    report::Text t;
    if (watched.turned_iteration > 0)
        go_on(t, words.say("run.turned", "face"_a = watched.turned_face, "step"_a = watched.turned_iteration));
    if (run.blew_up)
        go_on(t, words.say("run.blew_up", "step"_a = run.blow_up_iteration, "vertex"_a = run.blow_up_vertex,
                           "diagonals"_a = readable(SmoothingOptions().blow_up_at)));
    if (run.collapse_iteration > 0) go_on(t, words.say("run.collapsed", "steps"_a = run.iterations));
    return t;
}

report::Text about_fixed(const RebuiltFlow& flow) {
    const Smoothed& fixed = flow.fixed.run;
    const bool crosses = fixed.crossing_iteration > 0;
    const bool survives = crosses && !fixed.blew_up && fixed.collapse_iteration == 0;
    return paragraph_of({words.say("fixed"),
                         words.say(crosses ? "fixed.crosses" : "fixed.keeps", "mesh"_a = flow.name(), "step"_a = fixed.crossing_iteration,
                                   "vertex"_a = fixed.crossing_vertex, "largest"_a = readable(largest_product(fixed), 3)),
                         diagnosis(flow.fixed), survives ? words.say("fixed.survives", "steps"_a = fixed.iterations) : report::Text()});
}

report::Text about_adaptive(const RebuiltFlow& flow) {
    const Smoothed& adaptive = flow.adaptive.run;
    const double last = adaptive.steps.back().lambda / flow.lambda;
    const auto share = [&](const WatchedRun& run) { return readable_percent(double(run.inverted) / flow.source->mesh().face_count(), 1); };
    report::Text t = words.say(adaptive.crossing_iteration > 0 ? "adaptive.crosses" : "adaptive.keeps", "share"_a = readable(flow.share, 3),
                               "largest"_a = readable(largest_product(adaptive), 3));
    go_on(t, words.say(last < 0.5 ? "adaptive.short_time" : "adaptive.time",
                       "time"_a = readable_percent(adaptive.time / (flow.lambda * flow.iterations)), "last"_a = readable_percent(last, 2)));
    go_on(t, diagnosis(flow.adaptive));
    if (flow.fixed.inverted + flow.adaptive.inverted == 0) return t;
    go_on(t, words.say("adaptive.turned", "fixed"_a = share(flow.fixed), "adaptive"_a = share(flow.adaptive)));
    go_on(t, words.say("adaptive.chaotic"));
    return t;
}

report::Text about_frozen(const RebuiltFlow& flow) {
    const Smoothed& frozen = flow.frozen.run;
    return paragraph_of({words.say("frozen", "mesh"_a = flow.name(), "beyond"_a = readable(flow.beyond, 1),
                                   "factor"_a = readable(frozen.steps.front().top - 1, 2)),
                         diagnosis(flow.frozen),
                         frozen.blew_up ? report::Text() : words.say("frozen.survives", "steps"_a = frozen.iterations)});
}

}   // namespace

report::Text answer_of(const Studies& studies) {
    const Proofs proofs = proofs_of(studies);
    return words.say(proofs.all() ? "answer" : "answer.not_all", "limits"_a = proofs.named(), "width"_a = at_most(proofs.widest),
                     "operators"_a = proofs.limits, "semidefinite"_a = proofs.semidefinite);
}

void add_discussion(report::Section& section, const Studies& studies, const RebuiltFlow& flow) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {what_is_proved(studies)});
    for (const StabilityStudy& study : studies) add_paragraphs(section, {where_and_why(study)});
    add_paragraphs(section, {on_both_sides(studies), about_uniform(studies), about_fixed(flow), about_adaptive(flow), about_frozen(flow)});
}

}   // namespace meshfolio::stability
