// What the numbers of question 7 say: one theme a paragraph, all meshes side by side in it.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

using report::math;
using report::ref;

using Studies = std::vector<DenoisingStudy>;

/// "σ = 0.10 % (0.015 mean edges)".
std::string noise_of(const DenoisingStudy& study, const DenoisingTrial& trial) {
    return "σ = " + readable_percent(trial.relative, 2) + " (" + readable(trial.sigma / study.mean_edge, 2) + " mean edges)";
}

std::string gain_of(const DenoisingTrial& trial) {
    if (trial.best_rms == 0) return "no iteration is better than none";
    return "the error falls by a factor of " + readable(trial.gain()) + " at iteration " + std::to_string(trial.best_rms);
}

/// From the lowest to the highest level of noise on one mesh.
report::Text course_of(const DenoisingStudy& study) {
    const DenoisingTrial &low = study.trials.front(), &high = study.trials.back();
    report::Text t = report::text("On ", study.name(), " at ", noise_of(study, low), " ", gain_of(low));
    if (&low != &high) report::extend(t, "; at ", noise_of(study, high), " ", gain_of(high));
    if (high.best_rms == high.iterations()) {
        report::extend(t, ", and the minimum was not reached within ", counted(high.iterations(), "iteration"));
    }
    report::extend(t, " (", ref(id_of("q7", study.name(), "error_versus_iteration")), "). ");
    return t;
}

/// Whether more noise asks for more iterations: on every mesh alike, or on which.
report::Text noise_and_iterations(const Studies& studies) {
    std::vector<std::string> more, fewer;
    for (const DenoisingStudy& study : studies) {
        const int low = study.trials.front().best_rms, high = study.trials.back().best_rms;
        if (low != high)
            (high > low ? more : fewer).push_back(study.name() + " (" + std::to_string(low) + " to " + std::to_string(high) + ")");
    }
    report::Text t;
    if (!more.empty()) report::extend(t, "More noise asks for more iterations: on ", listed(more), ". ");
    if (!fewer.empty()) report::extend(t, "More noise asks for fewer iterations on ", listed(fewer), ". ");
    return t;
}

/// What it costs not to stop: of all trials that were taken to twice their best iteration, the dearest.
report::Text going_on(const Studies& studies) {
    const DenoisingStudy* where = nullptr;
    const DenoisingTrial* worst = nullptr;
    const auto loss = [](const DenoisingTrial& trial) { return trial.rms.back() / trial.rms[static_cast<std::size_t>(trial.best_rms)]; };
    for (const DenoisingStudy& study : studies) {
        for (const DenoisingTrial& trial : study.trials) {
            if (2 * trial.best_rms > trial.iterations() || (worst != nullptr && loss(trial) <= loss(*worst))) continue;
            where = &study;
            worst = &trial;
        }
    }
    if (worst == nullptr) return {};
    return report::text("Not stopping is dearest on ", where->name(), " at σ = ", readable_percent(worst->relative, 2), ": iteration ",
                        std::to_string(worst->iterations()), " leaves ", readable(loss(*worst), 2), " times the error ",
                        worst->best_rms == 0 ? "before any smoothing" : "of iteration " + std::to_string(worst->best_rms), ".");
}

report::Text what_happened(const Studies& studies) {
    report::Text t;
    for (const DenoisingStudy& study : studies) report::extend(t, course_of(study));
    report::extend(t, noise_and_iterations(studies), going_on(studies));
    return t;
}

/// Error on sharp edges over that elsewhere at the best iterations, lowest and highest over the trials; highest 0: no trial has any.
struct FeatureRatio {
    double lowest = INFINITY, highest = 0;
};

FeatureRatio feature_ratio(const DenoisingStudy& study) {
    FeatureRatio ratio;
    for (const DenoisingTrial& trial : study.trials) {
        if (trial.best_rms == 0) continue;
        ratio.lowest = std::min(ratio.lowest, trial.feature_rms / trial.smooth_rms);
        ratio.highest = std::max(ratio.highest, trial.feature_rms / trial.smooth_rms);
    }
    return ratio;
}

report::Text features_pay(const Studies& studies) {
    std::vector<std::string> larger, mixed, smaller, smooth, coarse;
    for (const DenoisingStudy& study : studies) {
        const int vertices = study.clean->mesh().vertex_count();
        const std::string share = std::to_string(study.feature_vertices) + " of " + std::to_string(vertices) + " vertices";
        const FeatureRatio ratio = feature_ratio(study);
        if (study.feature_vertices == 0) {
            smooth.push_back(study.name());
        } else if (2 * study.feature_vertices > vertices) {
            coarse.push_back(study.name() + " (" + share + ")");
        } else if (ratio.highest > 0) {
            const std::string range = readable(ratio.lowest, 3) + (ratio.highest > ratio.lowest ? " to " + readable(ratio.highest, 3) : "");
            (ratio.lowest > 1    ? larger
             : ratio.highest < 1 ? smaller
                                 : mixed)
                .push_back(study.name() + " (" + range + " times; " + share + ")");
        }
    }
    std::vector<std::string> kinds;
    if (!larger.empty()) kinds.push_back("larger on " + listed(larger));
    if (!smaller.empty()) kinds.push_back("smaller on " + listed(smaller));
    if (!mixed.empty()) kinds.push_back("neither always larger nor always smaller on " + listed(mixed));
    report::Text t;
    if (!kinds.empty())
        report::extend(t, "Where some smoothing is best, the error on edges sharper than 40°, over that elsewhere, is ", listed(kinds),
                       ".");
    if (!larger.empty()) report::extend(t, " The filter cannot tell such an edge from noise, and rounds it.");
    if (!smooth.empty())
        report::extend(t, t.empty() ? "" : " ", "There is no edge sharper than 40°, so no feature to lose, on ", listed(smooth), ".");
    if (!coarse.empty()) {
        report::extend(t, t.empty() ? "" : " ",
                       "Features and tessellation cannot be told apart where most vertices lie on edges sharper than 40°: on ",
                       listed(coarse), ".");
    }
    return t;
}

report::Text position_against_normals(const Studies& studies) {
    std::vector<std::string> disagree;
    for (const DenoisingStudy& study : studies) {
        for (const DenoisingTrial& trial : study.trials) {
            if (std::abs(trial.best_angle - trial.best_rms) < 3) continue;
            disagree.push_back(std::to_string(trial.best_rms) + " against " + std::to_string(trial.best_angle) +
                               (trial.best_angle == trial.iterations() ? " or later" : "") + " on " + study.name() +
                               " at σ = " + readable_percent(trial.relative, 2));
            break;
        }
    }
    if (disagree.empty()) return {};
    return report::text("Position and normals disagree about when to stop. The rms error is smallest at another iteration than the angle ",
                        "between face normals: ", listed(disagree), ".");
}

/// Above which noise, measured in mean edges, the gain reaches 1.2: a clean split of the cases or none.
report::Text limit_in_mean_edges(const Studies& studies) {
    const auto [smallest_helped, largest_failed] = noise_split(studies);
    if (!std::isfinite(smallest_helped) || largest_failed == 0) return {};
    if (largest_failed < smallest_helped) {
        return report::text(" Measured in mean edges the cases split cleanly: every σ up to ", readable(largest_failed, 2),
                            " gains less than 1.2, every one from ", readable(smallest_helped, 2), " on gains more.");
    }
    return report::text(" Noise in mean edges does not decide alone: a gain of 1.2 was reached from ", readable(smallest_helped, 2),
                        " mean edges on, but missed at up to ", readable(largest_failed, 2), ".");
}

report::Text verdict(const Studies& studies) {
    std::vector<std::string> works, fails;
    for (const DenoisingStudy& study : studies) {
        for (const DenoisingTrial& trial : study.trials) {
            const std::string name = study.name() + " at " + readable_percent(trial.relative, 2);
            const std::string outcome = outcome_of(trial);
            if (outcome == "works") works.push_back(name);
            if (outcome == "fails" || outcome == "harms") fails.push_back(name);
        }
    }
    report::Text t;
    if (works.empty()) {
        report::extend(t, "In none of the cases tried does smoothing halve the error.");
    } else {
        report::extend(t, "Smoothing at least halves the error on ", listed(works), ".");
    }
    if (fails.empty()) {
        report::extend(t, " In no case is the gain below 1.2.");
    } else {
        report::extend(t, " It gains less than a fifth, or nothing, on ", listed(fails), ".");
    }
    report::extend(t, limit_in_mean_edges(studies));
    report::extend(t,
                   " Bias and noise explain it: smoothing removes noise at a rate set by λ and the operator, and shape at a "
                   "rate set by the shape; it pays as long as the noise is larger than what the same iterations take from the clean mesh, "
                   "the curve without noise (",
                   ref(id_of("q7", studies.front().name(), "error_versus_iteration")),
                   "). Where the minimum is expected to be beside where it is measured, and how it is found without the "
                   "clean mesh, is in ",
                   ref("prediction"), ". Seven other methods, and other kinds of noise, are tried in ", ref("methods"), ".");
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<DenoisingStudy>& studies) {
    add_heading(section, "Discussion: when does it work, when does it fail?");
    add_paragraphs(section, {verdict(studies), what_happened(studies), features_pay(studies), position_against_normals(studies)});
}

}   // namespace meshfolio::q7_denoising
