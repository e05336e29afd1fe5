// What the numbers of the section "modes" say.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/modes/parts.h"

namespace meshfolio::modes {

namespace {

using report::math;
using report::ref;

report::Text damping_words(const std::vector<ModeStudy>& studies) {
    double worst = 0;
    int modes = 0;
    for (const ModeStudy& study : studies) {
        modes += static_cast<int>(study.eigenvalues.size());
        for (const ModeDamping& d : study.dampings) worst = std::max(worst, d.deviation(study.eigenvalues));
    }
    const ModeStudy& first = studies.front();
    const ModeDamping& close = first.dampings[1];
    const double top = first.subject.top.value;
    return report::text("The laws hold for every mode that was looked at, ", std::to_string(modes),
                        " in all: no coefficient is farther than ", readable(worst, 2), " from its law (", ref("modes_damping"),
                        "). They also say what is wrong with a step near the limit. After ", std::to_string(close.steps),
                        " explicit steps at 0.95 λ_crit ", readable_percent(std::abs(close.law(top)), 2),
                        " of the top mode is left, and it has changed its sign at every step, while the modes around ", math("μ = 1/λ"),
                        " are gone; at half the limit it is the top mode itself that is gone. Implicit steps leave less of a mode the "
                        "higher it is, at any ",
                        math("λ"), ".");
}

report::Text gap_words(const ModeStudy& study) {
    const SchemeGap* largest = nullptr;
    double worst = 0, worst_leading = 0;
    int compared = 0;
    for (const SchemeGap& gap : study.gaps) {
        if (gap.lambda > study.subject.critical || !(gap.motion > 0)) continue;
        if (!largest || gap.measured / gap.motion > largest->measured / largest->motion) largest = &gap;
        if (!seen(study, gap)) continue;
        ++compared;
        worst = std::max(worst, std::abs(gap.predicted / gap.measured - 1));
        worst_leading = std::max(worst_leading, std::abs(gap.leading / gap.measured - 1));
    }
    if (!largest) return {};
    const double share = largest->measured / largest->motion;
    report::Text t = report::text("Are the two schemes the same at the same ", math("λ"), " and ", math("t"), "? On ", study.name(),
                                  " they differ most, measured by their motion, at ", readable(largest->lambda / study.subject.critical, 2),
                                  "\u202fλ_crit after ", counted(largest->steps, "step"), ": by ", readable_percent(largest->measured, 2),
                                  " of the box, ", readable_percent(share, 2), " of the motion. ");
    constexpr double pixel = 1e-3, plain = 1e-2;   // of the box: in a picture of a thousand pixels
    report::extend(t, largest->measured < pixel   ? "In a picture that is less than a pixel. "
                      : largest->measured < plain ? "That is seen when they lie beside each other. "
                                                  : "That is not the same. ");
    if (compared == 0) return t;
    report::extend(t, "All gaps within the limit that stand out of rounding were predicted to ", readable(worst, 1), " before the runs (",
                   ref("modes_gap"), "); the first order in ", math("λ"), " alone is off by up to ", readable_percent(worst_leading, 2),
                   ".");
    return t;
}

/// "below 12 % of the energy", "everywhere", "nowhere".
std::string where(const ModeStudy& study, std::size_t which) {
    const auto& crossing = study.crossings[which];
    if (!crossing) return "nowhere";
    if (crossing->energy >= study.curve.front().energy) return "everywhere";
    return "below " + readable_percent(crossing->energy, 2) + " of the energy";
}

report::Text cost_words(const ModeStudy& study) {
    constexpr std::size_t fixed = std::size(implicit_steps), accurate = fixed, matched = fixed + 1;
    std::vector<std::string> parts;
    for (std::size_t which = 0; which < fixed; ++which)
        parts.push_back("with " + counted(implicit_steps[which], "step") + " " + where(study, which));
    report::Text t =
        report::text("Is implicit cheaper on ", study.name(), "? An implicit step costs as much as ",
                     readable(study.implicit_step / study.explicit_step, 2), " explicit ones and the factorisation as much as ",
                     readable(study.factor.factorisation / study.explicit_step, 2), ", so it depends on how smooth the result shall be (",
                     ref("modes_crossing"), "; looked at down to ", readable_percent(study.curve.back().energy, 2),
                     " of the energy). With its step chosen for the target it takes fewer operations ", listed(parts), ". ");
    const SmoothingTarget& last = study.curve.back();
    report::extend(t, "But these are not the same result: at ", readable_percent(last.energy, 2), " of the energy one implicit step is ",
                   readable_percent(last.implicit_ways.front().error, 2), " of the motion away from the exact flow, ten are ",
                   readable_percent(last.implicit_ways[fixed - 1].error, 2));
    if (last.explicit_way.steps > 0) report::extend(t, ", and the explicit result is ", readable_percent(last.explicit_way.error, 2));
    report::extend(t, ". Where ", readable_percent(implicit_accuracy, 1), " of the motion is true enough, implicit smoothing is cheaper ",
                   where(study, accurate), "; where it has to be as true as explicit smoothing, ", where(study, matched), ".");
    return t;
}

/// Where one way of smoothing becomes the cheaper one, over all meshes.
struct Border {
    std::string where;   // "between 5 % and 12 % of the energy", "at 5 % of the energy"; empty where there is no border on any mesh
    int never = 0, everywhere = 0;   // meshes on which it is nowhere, and at every energy looked at, the cheaper one
};
Border border(const std::vector<ModeStudy>& studies, std::size_t which) {
    Border found;
    double least = INFINITY, most = 0;
    for (const ModeStudy& study : studies) {
        const auto& crossing = study.crossings[which];
        if (!crossing) {
            ++found.never;
        } else if (crossing->energy >= study.curve.front().energy) {
            ++found.everywhere;
        } else {
            least = std::min(least, crossing->energy);
            most = std::max(most, crossing->energy);
        }
    }
    if (!(most > 0)) return found;
    const std::string low = readable_percent(least, 2), high = readable_percent(most, 2);
    found.where = (low == high ? "at " + low : "between " + low + " and " + high) + " of the energy";
    return found;
}

report::Text rule_words(const std::vector<ModeStudy>& studies) {
    const Border one = border(studies, 0), accurate = border(studies, std::size(implicit_steps));
    if (one.where.empty() && one.everywhere == 0) {
        return report::text(
            "Here, then, implicit smoothing does not pay for a single result; it pays where one factorisation serves many "
            "right-hand sides, or where no step may be too large.");
    }
    if (one.where.empty()) {
        return report::text("Here, then, a single implicit step is cheaper than explicit smoothing at every energy looked at",
                            one.never > 0 ? ", where it is at all." : ".");
    }
    report::Text t = report::text(
        "So the answer is neither yes nor no. Explicit smoothing is the cheaper one for light smoothing, implicit "
        "smoothing for strong smoothing; the border lies ",
        one.where, " for a single implicit step", one.never + one.everywhere > 0 ? ", where there is one," : "");
    if (accurate.where.empty()) {
        report::extend(t, ", and with an error of at most ", readable_percent(implicit_accuracy, 1), " there is none.");
    } else {
        report::extend(t, " and ", accurate.where, " for an error of at most ", readable_percent(implicit_accuracy, 1),
                       accurate.never + accurate.everywhere > 0 ? ", where there is one." : ".");
    }
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<ModeStudy>& studies) {
    add_heading(section, "Discussion");
    add_paragraphs(section, {damping_words(studies)});
    for (const ModeStudy& study : studies) add_paragraphs(section, {gap_words(study), cost_words(study)});
    add_paragraphs(section, {rule_words(studies)});
}

}   // namespace meshfolio::modes
