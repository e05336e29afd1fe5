// What the numbers of question 6 say.
#include <cmath>

#include "number_text.h"
#include "questions/discussions.h"
#include "questions/section_tools.h"
#include "questions/study_list.h"

namespace meshfolio {

namespace {

using report::math;
using report::ref;

report::Text agreement(const ImplicitStudy& study) {
    const SmoothingCell& cell = study.cell(0, study.middle_iteration());
    const double moved = vertex_rms(study.subject.mesh().X, cell.implicit_X);
    if (cell.explicit_X.size() == 0 || moved <= 0 || cell.lambda > study.subject.critical) return {};
    const double share = vertex_rms(cell.implicit_X, cell.explicit_X) / moved;
    report::Text t =
        report::text("Within the explicit limit the two methods ",
                     share < 0.05  ? "agree closely"
                     : share < 0.3 ? "agree roughly"
                                   : "differ",
                     " on ", study.name(), ": at λ = ", step_label(study.subject, cell.lambda), " and ",
                     counted(cell.iterations, "iteration"), " their results lie ", readable_percent(share, 2), " of the motion apart");
    report::extend(t, ", because ", math("1 − λμ"), " and ", math("1/(1 + λμ)"), " differ by ", math("(λμ)²"), " only where ", math("λμ"),
                   " is small.");
    return t;
}

report::Text beyond_the_limit(const ImplicitStudy& study) {
    const SmoothingCell* blown = nullptr;
    for (const SmoothingCell& cell : study.grid) {
        if (cell.explicit_blow_up > 0 && (blown == nullptr || cell.lambda < blown->lambda)) blown = &cell;
    }
    const SmoothingCell& far = study.cell(study.lambdas.size() - 1, study.middle_iteration());
    report::Text t;
    if (blown != nullptr) {
        report::extend(t, "Beyond the limit they part: at ", plain_text(blown->lambda / study.subject.critical, 3),
                       "\u202fλ_crit the explicit run on ", study.name(), " blows up in iteration ",
                       std::to_string(blown->explicit_blow_up), ", the implicit one does not. ");
    }
    if (far.collapsed()) {
        report::extend(t, "At ", plain_text(far.lambda / study.subject.critical, 3), "\u202fλ_crit and ",
                       counted(far.iterations, "iteration"), " ", study.name(),
                       " has collapsed to a point: stable is not the same as useful.");
        return t;
    }
    report::extend(t, "At ", plain_text(far.lambda / study.subject.critical, 3), "\u202fλ_crit and ", counted(far.iterations, "iteration"),
                   " it leaves ", readable_percent(far.implicit_energy, 2), " of the Dirichlet energy of ", study.name());
    if (std::isfinite(far.volume_ratio)) {
        report::extend(t, " and ", readable_percent(far.volume_ratio, 2), " of its volume",
                       far.volume_ratio < 0.5 ? ": stable is not the same as useful, the shape has shrunk away" : "");
    }
    if (far.inverted_faces > 0) report::extend(t, "; ", counted(far.inverted_faces, "face"), " point the other way");
    report::extend(t, ".");
    return t;
}

/// Is one step of 10 λ the same as ten of λ? Looks for two cells of equal λt.
report::Text iterations_against_steps(const ImplicitStudy& study) {
    for (const SmoothingCell& a : study.grid) {
        for (const SmoothingCell& b : study.grid) {
            if (a.iterations >= b.iterations || std::abs(a.lambda * a.iterations / (b.lambda * b.iterations) - 1) > 1e-9) continue;
            const double gap = vertex_rms(a.implicit_X, b.implicit_X), moved = vertex_rms(study.subject.mesh().X, b.implicit_X);
            const double share = gap / moved;
            return report::text("More iterations and larger steps are ",
                                share < 0.1   ? "nearly"
                                : share < 0.4 ? "roughly, but not quite,"
                                              : "not",
                                " interchangeable on ", study.name(), ": ", std::to_string(b.iterations), " steps of ",
                                plain_text(b.lambda / study.subject.critical, 3), "\u202fλ_crit and ", std::to_string(a.iterations), " of ",
                                plain_text(a.lambda / study.subject.critical, 3), "\u202fλ_crit end ", readable_percent(share, 2),
                                " of the motion apart. Many small steps damp the high modes exponentially, one large "
                                "step only like ",
                                math("1/(1 + λμ)"), ".");
        }
    }
    return {};
}

report::Text price(const ImplicitStudy& study) {
    const SmoothingCost& cost = study.cost;
    report::Text t = report::text("Is implicit cheaper? To bring ", study.name(), " to ", readable_percent(cost.energy),
                                  " of its energy takes ", counted(cost.implicit_steps, "implicit step"), " or ");
    if (cost.explicit_steps == 0) {
        report::extend(t, "more than 3000 explicit ones: for this much smoothing the implicit method is the only practical one.");
        return t;
    }
    const double ratio = cost.explicit_operations / cost.implicit_operations;
    report::extend(t, counted(cost.explicit_steps, "explicit one"), ". An implicit step costs ",
                   readable(2.0 * double(cost.factor_nonzeros) / double(cost.operator_nonzeros), 2),
                   " times an explicit one, so in multiply–adds of the steps the explicit way is ",
                   ratio > 1 ? readable(ratio, 2) + " times as expensive" : "cheaper, " + readable(1 / ratio, 2) + " times", " (",
                   ref("q6_cost"), "), before the one factorisation is counted",
                   ratio > 1 ? "." : ": at this smoothness the implicit method buys stability, not speed.");
    return t;
}

}   // namespace

void add_implicit_discussion(report::Section& section, const std::vector<ImplicitStudy>& studies) {
    add_heading(section, "Discussion");
    for (const ImplicitStudy& study : studies) {
        add_paragraphs(section, {agreement(study), beyond_the_limit(study), iterations_against_steps(study), price(study)});
    }
}

}   // namespace meshfolio
