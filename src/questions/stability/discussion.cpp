// What the numbers of the section "stability" say.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

using report::math;
using report::ref;

report::Text what_is_proved(const std::vector<StabilityStudy>& studies) {
    double widest = 0, rounding = 0;
    double below = 0;
    int refuted = 0, proved = 0, semidefinite = 0;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            widest = std::max(widest, limit->certificate.relative_width());
            rounding = std::max(rounding, limit->certificate.rounding);
            refuted += limit->certificate.refuted() ? 1 : 0;
            below = std::max(below, -limit->certificate.bottom.mu_low / limit->certificate.mu_high);
            semidefinite += limit->certificate.bottom.semidefinite() ? 1 : 0;
            ++proved;
        }
    }
    if (semidefinite < proved) {
        return report::text("Of ", counted(proved, "operator"), " only ", std::to_string(semidefinite),
                            " are proved negative semidefinite: of the others no step is proved stable (", ref("stability_certificates"),
                            "). μ_max is enclosed to ", readable(widest, 2), " or better, relative.");
    }
    report::Text t = report::text(proved == 2 ? std::string("Both limits") : "All " + counted(proved, "limit"), " are known to ",
                                  readable(widest, 2), " or better, relative, and proved from both sides (", ref("stability_certificates"),
                                  "). The rounding of a factorisation, at most ", readable(rounding, 2), " here, is part of the bounds. ");
    if (refuted == 0) {
        report::extend(t, "No factorisation broke down: each value of Lanczos was the largest eigenvalue.");
    } else {
        report::extend(t, "In ", counted(refuted, "case"),
                       " the factorisation just above the value of Lanczos broke down; the limit was then "
                       "found by Lanczos with the inverse of a factor from farther above.");
    }
    report::extend(t, " No operator has a mode that grows by itself: no eigenvalue of −L lies below 0 by more than ", readable(below, 2),
                   " of ", math("μ_max"), ", the rounding of what is stored.");
    return t;
}

/// What makes that vertex fast: its rate is weights over area, and each takes its part of it on a logarithmic scale.
std::string why(const LimitingVertex& v) {
    if (v.rate() < 1.5) return "so their ratio, the rate, is near the usual one: nothing stands out.";
    const double by_area = -std::log(v.area_share) / std::log(v.rate());
    const std::string rate = "so that their ratio, the rate, is " + readable(v.rate(), 3) + " times the usual one: ";
    if (by_area > 0.75) return rate + "the small area makes it fast.";
    if (by_area < 0.25) return rate + "the large weights make it fast.";
    return rate + "both make it fast.";
}

report::Text where_and_why(const StabilityStudy& study) {
    const LargestEigenvalue& top = study.cotangent.certificate.top;
    const LimitingVertex& v = study.limiting;
    const double sharing = std::max(1.0, top.support);
    const std::string share = readable(sharing, 2) + " of " + std::to_string(study.mesh().vertex_count()) + " vertices";
    if (sharing > std::max(8.0, 0.05 * study.mesh().vertex_count())) {
        return report::text("On ", study.name(), " the triangulation as a whole sets the limit: about ", share,
                            " share the mode, which is largest at vertex ", std::to_string(v.vertex), ".");
    }
    return report::text("On ", study.name(), " vertex ", std::to_string(v.vertex), " sets the limit; about ", share,
                        " share the mode. Its area is ", readable(v.area_share, 2), " of the mean and its weights add up to ",
                        readable(v.stiffness_share, 2), " times the median, ", why(v));
}

report::Text growth_words(const std::vector<StabilityStudy>& studies) {
    double off = 0, highest = 0;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            off = std::max(off, std::abs(limit->beyond.factor.back() / limit->beyond.predicted(limit->beyond.steps()) - 1));
            highest = std::max(highest, limit->below.factor.back());
        }
    }
    const ModeGrowth& beyond = studies.front().cotangent.beyond;
    return report::text("A hundredth is enough to tell the two sides apart. In ", counted(beyond.steps(), "step"),
                        " at 1.01\u202fλ_crit the top mode is predicted to grow ", readable(beyond.predicted(beyond.steps()), 5),
                        "-fold; measured, it is off by at most ", readable(off, 2), " relative, with either operator. At 0.99\u202fλ_crit ",
                        readable(highest, 2), " of it is left at most, where ",
                        readable(studies.front().cotangent.below.predicted(beyond.steps()), 4), " is predicted (", ref("stability_growth"),
                        "); below about 10⁻⁸ rounding may hold it up.");
}

report::Text uniform_words(const std::vector<StabilityStudy>& studies) {
    double low = INFINITY, high = 0, ratio_low = INFINITY, ratio_high = 0;
    for (const StabilityStudy& study : studies) {
        low = std::min(low, study.uniform.critical());
        high = std::max(high, study.uniform.critical());
        const double ratio = study.cotangent.critical() / (study.mean_edge * study.mean_edge);
        ratio_low = std::min(ratio_low, ratio);
        ratio_high = std::max(ratio_high, ratio);
    }
    report::Text t = report::text("The uniform operator sees no shapes, only who is joined to whom: its limit is ", readable(low, 4));
    if (studies.size() > 1) report::extend(t, " to ", readable(high, 4));
    report::extend(t, ", and never below 1, since its spectrum ends at 2. That of the cotangent operator is ", readable(ratio_low, 2));
    if (studies.size() > 1) report::extend(t, " to ", readable(ratio_high, 2));
    report::extend(t, " of the squared mean edge (", ref("stability_units"),
                   "), so λ/h̄² does not say whether a step is stable; τ does, and ℓ says how much it smooths.");
    return t;
}

/// "In step 4 face 12 is turned over; …": what went wrong in a run, in the order it is looked at.
report::Text diagnosis(const WatchedRun& watched) {
    const Smoothed& run = watched.run;
    report::Text t;
    if (watched.turned_iteration > 0) {
        report::extend(t, " Face ", std::to_string(watched.turned_face), " is the first to be turned over, in step ",
                       std::to_string(watched.turned_iteration), ".");
    }
    if (run.blew_up) {
        report::extend(t, " In step ", std::to_string(run.blow_up_iteration), " vertex ", std::to_string(run.blow_up_vertex),
                       " is farther than ", readable(SmoothingOptions().blow_up_at), " box diagonals away: the run has blown up.");
    }
    if (run.collapse_iteration > 0) {
        report::extend(t, " After ", counted(run.iterations, "step"),
                       " nothing is left of the surface: the flow has shrunk it to points or lines, and no operator can be built.");
    }
    return t;
}

report::Text fixed_words(const RebuiltFlow& flow) {
    const Smoothed& fixed = flow.fixed.run;
    report::Text t = report::text("With the operator rebuilt from the current positions the law holds for each step alone. On ",
                                  flow.name(), " half the limit of the input ");
    if (fixed.crossing_iteration > 0) {
        report::extend(t, "is beyond the limit in step ", std::to_string(fixed.crossing_iteration), ", first at vertex ",
                       std::to_string(fixed.crossing_vertex), "; ", math("λμ_max"), " goes up to ", readable(largest_product(fixed), 3),
                       ".");
    } else {
        report::extend(t, "stays a stable step throughout: ", math("λμ_max"), " is ", readable(largest_product(fixed), 3), " at most.");
    }
    report::extend(t, diagnosis(flow.fixed));
    if (fixed.crossing_iteration > 0 && !fixed.blew_up && fixed.collapse_iteration == 0) {
        report::extend(t, " Yet it does not blow up in ", counted(fixed.iterations, "step"), "; in the last of them ", math("λμ_max"),
                       " is ", readable(fixed.steps.back().top, 3), ".");
    }
    return t;
}

report::Text adaptive_words(const RebuiltFlow& flow) {
    const Smoothed& adaptive = flow.adaptive.run;
    report::Text t =
        report::text("The adaptive step, which takes at most ", readable(flow.share, 3), " of what the bound of each operator allows, ");
    report::extend(t, adaptive.crossing_iteration > 0 ? "crossed the limit too, which the bound excludes: a fault of this program. It"
                                                      : "never crosses it (" + readable(largest_product(adaptive), 3) + " at most). It");
    report::extend(t, " reaches ", readable_percent(adaptive.time / (flow.lambda * flow.iterations)), " of the diffusion time asked for");
    if (adaptive.steps.back().lambda < 0.5 * flow.lambda) {
        report::extend(t, ", for the last step is only ", readable_percent(adaptive.steps.back().lambda / flow.lambda, 2),
                       " of the fixed step: where the flow shrinks triangles to nothing, so does the limit");
    }
    report::extend(t, ".");
    report::extend(t, diagnosis(flow.adaptive));
    report::extend(t, " At the end ", counted(flow.fixed.inverted, "face"), " of ", std::to_string(flow.source->mesh().face_count()),
                   flow.fixed.inverted == 1 ? " is" : " are", " turned over with fixed λ, ", std::to_string(flow.adaptive.inverted),
                   " with the adaptive one.");
    return t;
}

report::Text frozen_words(const RebuiltFlow& flow) {
    const WatchedRun& frozen = flow.frozen;
    report::Text t = report::text("With the operator of the input kept, at ", readable(flow.beyond, 1),
                                  " times the limit, the top mode is multiplied by ", readable(frozen.run.steps.front().top - 1, 2),
                                  " in every step, and nothing stops it (", ref(id_of("stability", flow.name(), "flow_table")), ").");
    report::extend(t, diagnosis(frozen));
    if (!frozen.run.blew_up) {
        report::extend(t, " Yet ", counted(frozen.run.iterations, "step"),
                       " leave it within the box: the mesh has nothing, or almost nothing, of that mode.");
    }
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<StabilityStudy>& studies, const RebuiltFlow& flow) {
    add_heading(section, "Discussion");
    add_paragraphs(section, {what_is_proved(studies)});
    for (const StabilityStudy& study : studies) add_paragraphs(section, {where_and_why(study)});
    add_paragraphs(section, {growth_words(studies), uniform_words(studies), fixed_words(flow), adaptive_words(flow), frozen_words(flow)});
}

}   // namespace meshfolio::stability
