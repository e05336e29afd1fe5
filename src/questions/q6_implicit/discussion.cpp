// What the numbers of question 6 say: one theme a paragraph, all meshes side by side in it.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

using report::math;
using report::ref;

using Studies = std::vector<ImplicitStudy>;

std::string in_limits(const ImplicitStudy& study, double lambda) { return plain_text(lambda / study.subject.critical, 3) + "\u202fλ_crit"; }

/// How far apart the two schemes end within the explicit limit, as a share of the motion; NaN where there is nothing to compare.
double gap_within_the_limit(const ImplicitStudy& study) {
    const SmoothingCell& cell = study.cell(0, study.middle_iteration());
    const double moved = vertex_rms(study.subject.mesh().X, cell.implicit_X);
    if (cell.explicit_X.size() == 0 || moved <= 0 || cell.lambda > study.subject.critical) return NAN;
    return vertex_rms(cell.implicit_X, cell.explicit_X) / moved;
}

report::Text agreement(const Studies& studies) {
    std::vector<Observed> gaps;
    for (const ImplicitStudy& study : studies) {
        const double gap = gap_within_the_limit(study);
        if (std::isnan(gap)) continue;
        const SmoothingCell& cell = study.cell(0, study.middle_iteration());
        gaps.push_back({std::string(gap < 0.05  ? "closely"
                                    : gap < 0.3 ? "roughly"
                                                : "badly") +
                            " on " + study.name() + " (" + readable_percent(gap, 2) + " of the motion apart)",
                        "after " + counted(cell.iterations, "iteration") + " at " + in_limits(study, cell.lambda)});
    }
    if (gaps.empty()) return {};
    return report::text("Within the explicit limit the two methods agree ", listed_observed(gaps), ". The factors ", math("1 − λμ"),
                        " and ", math("1/(1 + λμ)"), " differ by ", math("(λμ)²"), " only where ", math("λμ"),
                        " is small; the modes near the limit tell them apart.");
}

/// Where the explicit runs end, one entry a mesh that has one.
std::vector<Observed> explicit_ends(const Studies& studies) {
    std::vector<Observed> ends;
    for (const ImplicitStudy& study : studies) {
        const SmoothingCell* blown = nullptr;
        for (const SmoothingCell& cell : study.grid) {
            if (cell.explicit_blow_up > 0 && (blown == nullptr || cell.lambda < blown->lambda)) blown = &cell;
        }
        if (blown == nullptr) continue;
        ends.push_back(
            {"in iteration " + std::to_string(blown->explicit_blow_up) + " on " + study.name(), "at " + in_limits(study, blown->lambda)});
    }
    return ends;
}

/// What the largest implicit step leaves of a mesh.
Observed remains_of(const ImplicitStudy& study) {
    const SmoothingCell& far = study.cell(study.lambdas.size() - 1, study.middle_iteration());
    const std::string when = "after " + counted(far.iterations, "iteration") + " at " + in_limits(study, far.lambda);
    if (far.collapsed()) return {study.name() + " has collapsed to a point", when};
    std::string told = study.name() + " keeps " + readable_percent(far.implicit_energy, 2) + " of its Dirichlet energy";
    if (std::isfinite(far.volume_ratio)) told += " and " + readable_percent(far.volume_ratio, 2) + " of its volume";
    if (far.inverted_faces > 0) told += ", with " + counted(far.inverted_faces, "face") + " turned over";
    return {told, when};
}

bool has_lost_its_shape(const ImplicitStudy& study) {
    const SmoothingCell& far = study.cell(study.lambdas.size() - 1, study.middle_iteration());
    // An open mesh has no volume; what it has lost shows in its energy.
    return far.collapsed() || (std::isfinite(far.volume_ratio) ? far.volume_ratio < 0.5 : far.implicit_energy < 0.05);
}

report::Text beyond_the_limit(const Studies& studies) {
    report::Text t;
    const std::vector<Observed> ends = explicit_ends(studies);
    if (!ends.empty())
        report::extend(t, "Beyond the limit they part: the explicit run blows up ", listed_observed(ends),
                       "; the implicit one does so nowhere. ");
    std::vector<Observed> lost, kept;
    for (const ImplicitStudy& study : studies) (has_lost_its_shape(study) ? lost : kept).push_back(remains_of(study));
    if (!lost.empty()) report::extend(t, "Stable is not the same as useful: ", listed_observed(lost), ".");
    if (!kept.empty()) {
        report::extend(t, lost.empty() ? "Nothing stops the implicit method from going on: " : " Elsewhere ", listed_observed(kept), ".");
    }
    return t;
}

/// Two cells of equal λt: one step of 10 λ against ten of λ, say.
struct EqualTime {
    const SmoothingCell *few = nullptr, *many = nullptr;
    double share = NAN;   // distance of the results over the motion
};

EqualTime equal_time(const ImplicitStudy& study) {
    for (const SmoothingCell& a : study.grid) {
        for (const SmoothingCell& b : study.grid) {
            if (a.iterations >= b.iterations || std::abs(a.lambda * a.iterations / (b.lambda * b.iterations) - 1) > 1e-9) continue;
            return {&a, &b, vertex_rms(a.implicit_X, b.implicit_X) / vertex_rms(study.subject.mesh().X, b.implicit_X)};
        }
    }
    return {};
}

report::Text iterations_against_steps(const Studies& studies) {
    std::vector<Observed> compared;
    double worst = 0;
    for (const ImplicitStudy& study : studies) {
        const EqualTime pair = equal_time(study);
        if (!std::isfinite(pair.share)) continue;
        worst = std::max(worst, pair.share);
        compared.push_back({readable_percent(pair.share, 2) + " of the motion on " + study.name(),
                            counted(pair.many->iterations, "step") + " of " + in_limits(study, pair.many->lambda) + " against " +
                                std::to_string(pair.few->iterations) + " of " + in_limits(study, pair.few->lambda)});
    }
    if (compared.empty()) return {};
    return report::text("More iterations and larger steps are ",
                        worst < 0.1   ? "nearly"
                        : worst < 0.4 ? "roughly, but not quite,"
                                      : "not",
                        " interchangeable. After the same time λt the results lie apart by ", listed_observed(compared),
                        ": many small steps damp the high modes exponentially, one large step only like ", math("1/(1 + λμ)"), ".");
}

report::Text price(const Studies& studies) {
    std::vector<std::string> steps, step_ratios, ratios, speedless, hopeless;
    for (const ImplicitStudy& study : studies) {
        const SmoothingCost& cost = study.cost;
        const bool first = steps.empty();
        steps.push_back(study.name() + " to " + readable_percent(cost.energy) + (first ? " of its energy takes " : ": ") +
                        (first ? counted(cost.implicit_steps, "implicit step") : std::to_string(cost.implicit_steps)) + " or " +
                        (cost.explicit_steps > 0 ? std::to_string(cost.explicit_steps) : "more than 3000") +
                        (first ? " explicit ones" : ""));
        if (cost.explicit_steps == 0) {
            hopeless.push_back(study.name());
            continue;
        }
        step_ratios.push_back(readable(2.0 * double(cost.factor_nonzeros) / double(cost.operator_nonzeros), 2));
        ratios.push_back(readable(cost.explicit_operations / cost.implicit_operations, 2));
        if (cost.explicit_operations <= cost.implicit_operations) speedless.push_back(study.name());
    }
    report::Text t = report::text("Is implicit cheaper? To bring ", listed(steps), " (", ref("q6_cost"), ").");
    if (!ratios.empty()) {
        report::extend(t, " An implicit step costs ", listed(step_ratios),
                       " times an explicit one, so in multiply–adds the explicit way is ", listed(ratios),
                       " times as expensive, before the one factorisation is counted.");
    }
    if (!speedless.empty()) report::extend(t, " On ", listed(speedless), " the implicit method buys stability, not speed.");
    if (!hopeless.empty()) report::extend(t, " For so much smoothing it is the only practical one on ", listed(hopeless), ".");
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<ImplicitStudy>& studies) {
    add_heading(section, "Discussion");
    add_paragraphs(section, {agreement(studies), beyond_the_limit(studies), iterations_against_steps(studies), price(studies)});
}

}   // namespace meshfolio::q6_implicit
