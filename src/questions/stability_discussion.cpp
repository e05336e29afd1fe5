// What the numbers of the section "stability" say.
#include <algorithm>
#include <cmath>

#include "number_text.h"
#include "questions/section_tools.h"
#include "questions/stability_section.h"
#include "questions/study_list.h"

namespace meshfolio {

namespace {

using report::math;
using report::ref;

report::Text what_is_proved(const std::vector<StabilityStudy>& studies) {
    double widest = 0, rounding = 0;
    int refuted = 0, proved = 0;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            widest = std::max(widest, limit->certificate.relative_width());
            rounding = std::max(rounding, limit->certificate.rounding);
            refuted += limit->certificate.refuted() ? 1 : 0;
            ++proved;
        }
    }
    report::Text t = report::text("All ", counted(proved, "limit"), " are known to ", readable(widest, 2),
                                  " or better, relative, and proved from both sides (", ref("stability_certificates"),
                                  "). The rounding of a factorisation, at most ", readable(rounding, 2), " here, is part of the bounds. ");
    if (refuted == 0) {
        report::extend(t, "No factorisation broke down: each value of Lanczos was the largest eigenvalue.");
    } else {
        report::extend(t, "In ", counted(refuted, "case"),
                       " the factorisation just above the value of Lanczos broke down; the limit was then "
                       "found by bisection.");
    }
    return t;
}

report::Text where_and_why(const StabilityStudy& study) {
    const LargestEigenvalue& top = study.cotangent.certificate.top;
    const LimitingVertex& v = study.limiting;
    report::Text t = report::text("On ", study.name(), " vertex ", std::to_string(v.vertex), " sets the limit; about ",
                                  readable(std::max(1.0, top.support), 2), " of ", std::to_string(study.mesh().vertex_count()),
                                  " vertices share the mode. ");
    if (top.support > 0.05 * study.mesh().vertex_count()) {
        report::extend(t, "That is the triangulation as a whole: no vertex is to blame.");
        return t;
    }
    const bool small = v.area_share<0.5, stiff = v.stiffness_share> 2;
    report::extend(t, "Its area is ", readable(v.area_share, 2), " of the mean and its weights add up to ", readable(v.stiffness_share, 2),
                   " times the median: ",
                   small && stiff ? "both make it fast."
                   : small        ? "the small area makes it fast."
                   : stiff        ? "the large weights make it fast."
                                  : "neither alone stands out.");
    return t;
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

report::Text flow_words(const RebuiltFlow& flow) {
    const Smoothed& fixed = flow.fixed;
    report::Text t = report::text("With the operator rebuilt from the current positions the law holds for each step alone. On ",
                                  flow.name(), " half the limit of the input ");
    if (fixed.crossing_iteration > 0) {
        report::extend(t, "is beyond the limit in step ", std::to_string(fixed.crossing_iteration), ", first at vertex ",
                       std::to_string(fixed.crossing_vertex), "; ", math("λμ_max"), " goes up to ", readable(largest_product(fixed), 3),
                       ".");
    } else {
        report::extend(t, "stays a stable step throughout: ", math("λμ_max"), " is ", readable(largest_product(fixed), 3), " at most.");
    }
    if (fixed.blew_up) {
        report::extend(t, " In step ", std::to_string(fixed.blow_up_iteration), " vertex ", std::to_string(fixed.blow_up_vertex),
                       " leaves a thousand box diagonals.");
    }
    const double reached = flow.adaptive.time / (flow.lambda * flow.iterations);
    report::extend(t, " The adaptive step, which takes at most ", readable(flow.share, 3), " of what the bound of each operator allows, ");
    report::extend(t, flow.adaptive.crossing_iteration > 0
                          ? "crossed the limit too, which the bound excludes: a fault of this program. It"
                          : "never crosses it (" + readable(largest_product(flow.adaptive), 3) + " at most). It");
    report::extend(t, " reaches ", readable_percent(reached), " of the diffusion time in as many steps");
    if (flow.adaptive.steps.back().lambda < 0.5 * flow.lambda) {
        report::extend(t, ", for the last step is only ", readable_percent(flow.adaptive.steps.back().lambda / flow.lambda, 2),
                       " of the first asked for: where the flow shrinks triangles to nothing, so does the limit");
    }
    report::extend(t, ". At the end ", counted(flow.fixed_inverted, "face"), " of ", std::to_string(flow.source->mesh().face_count()),
                   " are turned over with fixed λ, ", std::to_string(flow.adaptive_inverted), " with the adaptive one.");
    return t;
}

}   // namespace

void add_stability_discussion(report::Section& section, const std::vector<StabilityStudy>& studies, const RebuiltFlow& flow) {
    add_heading(section, "Discussion");
    add_paragraphs(section, {what_is_proved(studies)});
    for (const StabilityStudy& study : studies) add_paragraphs(section, {where_and_why(study)});
    add_paragraphs(section, {growth_words(studies), uniform_words(studies), flow_words(flow)});
}

}   // namespace meshfolio
