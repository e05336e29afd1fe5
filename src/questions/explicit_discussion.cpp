// What the numbers of question 5 say.
#include <algorithm>
#include <cmath>

#include "number_text.h"
#include "questions/discussions.h"
#include "questions/section_tools.h"
#include "questions/study_list.h"

namespace meshfolio {

namespace {

using report::math;
using report::ref;

/// How long the volume lasts, and faces turned over: what the smoothing costs the shape.
report::Text price_in_shape(const ExplicitStudy& study, const SmoothingRun& run) {
    report::Text t;
    if (const int kept = iterations_keeping_volume(run, 0.95); kept >= 0) {
        report::extend(t, " That is too long where the shape matters: 95\u202f% of the volume are kept for ", counted(kept, "iteration"),
                       ".");
    }
    if (run.moved.inverted_faces > 0) {
        report::extend(t, " ", counted(run.moved.inverted_faces, "face"), " of ", std::to_string(study.subject.mesh().face_count()),
                       " end turned against the input.");
    }
    return t;
}

report::Text good_step(const ExplicitStudy& study) {
    const SmoothingSubject& subject = study.subject;
    report::Text t = report::text("On ", subject.name(), " explicit smoothing is stable up to ", math("λ_crit = 2/μ_max"), " = ",
                                  readable(subject.critical, 4), " (",
                                  readable(subject.critical / (subject.mean_edge * subject.mean_edge), 2), " of the squared mean edge).");
    if (study.best < 0) {
        report::extend(t, " None of the steps tried lies below that limit, so none can be recommended.");
        return t;
    }
    const SmoothingRun& best = study.runs[static_cast<std::size_t>(study.best)];
    report::extend(t, " Of the steps tried, λ = ", step_label(subject, best.lambda), " is the one to use: ");
    if (keeps_signs(subject, best.lambda)) {
        report::extend(t, "no mode changes its sign (", math("λμ ≤ 1"), "), and ");
    } else {
        report::extend(t, "it is stable, though the highest modes change sign from step to step, and ");
    }
    report::extend(t, "in ", counted(best.result.iterations, "iteration"), " it takes the Dirichlet energy to ",
                   readable_percent(best.energy.back()), " while the vertices move ", readable_percent(best.moved.rms / subject.diagonal),
                   " of the box diagonal (rms)");
    if (std::isfinite(best.volume_ratio)) report::extend(t, " and the volume goes to ", readable_percent(best.volume_ratio, 4));
    report::extend(t, ".", price_in_shape(study, best));
    return t;
}

report::Text why_that_limit(const ExplicitStudy& study) {
    const SmoothingSubject& subject = study.subject;
    const double ratio = subject.critical / (subject.mean_edge * subject.mean_edge);
    report::Text t = report::text("The top mode is shared by about ", readable(std::max(1.0, subject.top.support), 2), " of ",
                                  std::to_string(subject.source->prepared->preflight.vertices_in_use), " vertices");
    const int vertices = subject.source->prepared->preflight.vertices_in_use;
    if (subject.top.support < 10 && subject.top.support < 0.5 * vertices) {
        report::extend(t, ": a single spot around vertex ", std::to_string(subject.top.vertex),
                       ", with small area or large cotangents, sets the limit for all");
    } else if (subject.top.support < 0.05 * vertices) {
        report::extend(t, ": a small region around vertex ", std::to_string(subject.top.vertex), " sets the limit for all");
    } else {
        report::extend(t, ": the limit is set by the triangulation as a whole, not by one bad vertex");
    }
    report::extend(t, ". On a regular triangulation the limit would be a quarter to a third of the squared edge; here it is ",
                   readable(ratio, 2), ".");
    return t;
}

report::Text too_large(const ExplicitStudy& study) {
    for (std::size_t i = 0; i < study.runs.size(); ++i) {
        const SmoothingRun& run = study.runs[i];
        if (study.stable(i)) continue;
        const double factor = std::abs(1 - run.lambda * study.subject.top.value);
        report::Text t =
            report::text("Too large a step amplifies what it should remove. At ", plain_text(run.lambda / study.subject.critical, 3),
                         "\u202fλ_crit the top mode of ", study.name(), " is multiplied by ", math("1 − λμ_max"), " = \u2212",
                         readable(factor, 3), " a step: it flips and grows, ", readable(study.amplification[i].measured, 3),
                         "-fold in 20 steps as measured (", readable(study.amplification[i].predicted, 3), " predicted).");
        const SmoothingRun& last = study.runs.back();
        if (last.result.blew_up) {
            report::extend(t, " At ", plain_text(last.lambda / study.subject.critical, 3),
                           "\u202fλ_crit the mesh leaves a thousand box diagonals in iteration ",
                           std::to_string(last.result.blow_up_iteration), ", first at vertex ", std::to_string(last.result.blow_up_vertex),
                           ".");
        } else if (last.moved.inverted_faces > 0) {
            report::extend(t, " At ", plain_text(last.lambda / study.subject.critical, 3), "\u202fλ_crit ",
                           counted(last.moved.inverted_faces, "face"), " of ", std::to_string(study.subject.mesh().face_count()),
                           " are turned over after ", counted(last.result.iterations, "iteration"), ".");
        }
        const double start = run.energy.front(), end = run.energy.back();
        if (end < start) {
            report::extend(t, " Just beyond the limit this is invisible at first: at ", plain_text(run.lambda / study.subject.critical, 3),
                           "\u202fλ_crit the energy has still fallen to ", readable_percent(end), " after ",
                           counted(run.result.iterations, "iteration"), ".");
        }
        return t;
    }
    return report::text("No step tried on ", study.name(), " exceeds the limit.");
}

report::Text units_of_lambda(const std::vector<ExplicitStudy>& studies) {
    double low = INFINITY, high = 0, uniform_low = INFINITY, uniform_high = 0;
    for (const ExplicitStudy& study : studies) {
        low = std::min(low, study.subject.critical);
        high = std::max(high, study.subject.critical);
        uniform_low = std::min(uniform_low, study.uniform.critical);
        uniform_high = std::max(uniform_high, study.uniform.critical);
    }
    report::Text t = report::text("λ is an area: it scales with the square of the mesh");
    if (studies.size() > 1)
        report::extend(t, ", and from mesh to mesh the limit varies ", readable(high / low, 2), "-fold (", ref("q5_limits"), ")");
    report::extend(t, ". A λ quoted without its mesh says nothing. The uniform operator has no unit; its limit is ",
                   readable(uniform_low, 3));
    if (studies.size() > 1) report::extend(t, " to ", readable(uniform_high, 3));
    report::extend(t, uniform_low > 1 && uniform_high < 1.5 ? " here, which is why λ = 1 works there and λ = 1.5 does not." : " here.");
    report::extend(t, " That the limits are what they are is proved in ", ref("stability"), ".");
    return t;
}

}   // namespace

void add_explicit_discussion(report::Section& section, const std::vector<ExplicitStudy>& studies) {
    add_heading(section, "Discussion: what is a good λ, and what if it is too large?");
    for (const ExplicitStudy& study : studies) add_paragraphs(section, {good_step(study), why_that_limit(study), too_large(study)});
    add_paragraphs(section, {units_of_lambda(studies)});
}

}   // namespace meshfolio
