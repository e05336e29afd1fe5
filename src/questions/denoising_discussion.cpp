// What the numbers of question 7 say.
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

report::Text what_happened(const DenoisingStudy& study) {
    const DenoisingTrial &low = study.trials.front(), &high = study.trials.back();
    const auto told = [&](const DenoisingTrial& trial) {
        std::string s = "at σ = " + readable_percent(trial.relative, 2) + " of the diagonal (" +
                        readable(trial.sigma / study.mean_edge, 2) + " mean edges) ";
        if (trial.best_rms == 0) return s + "no iteration is better than none";
        return s + "the error falls by a factor of " + readable(trial.gain()) + " at iteration " + std::to_string(trial.best_rms);
    };
    report::Text t = report::text("On ", study.name(), " ", told(low));
    if (&low != &high) report::extend(t, ", ", told(high));
    report::extend(t, " (", ref(id_of("q7", study.name(), "error_versus_iteration")), ").");
    if (&low != &high && low.best_rms != high.best_rms) {
        report::extend(t, " More noise asks for ", high.best_rms > low.best_rms ? "more" : "fewer",
                       " iterations, as far as these levels go.");
    }
    const bool at_end = std::any_of(study.trials.begin(), study.trials.end(),
                                    [&](const DenoisingTrial& trial) { return trial.best_rms == trial.iterations(); });
    if (at_end)
        report::extend(t, " At the highest level the minimum was not reached within ",
                       counted(study.trials.back().iterations(), "iteration"), ".");
    for (const DenoisingTrial& trial : study.trials) {
        if (trial.best_rms == 0 || 2 * trial.best_rms > trial.iterations()) continue;
        report::extend(t, " Going on to iteration ", std::to_string(trial.iterations()), " at σ = ", readable_percent(trial.relative, 2),
                       " leaves ", readable(trial.rms.back() / trial.rms[static_cast<std::size_t>(trial.best_rms)], 2),
                       " times the smallest error.");
        break;
    }
    return t;
}

report::Text features_pay(const DenoisingStudy& study) {
    if (study.feature_vertices == 0) {
        return report::text(study.name(), " has no edge sharper than 40°, so there is no feature to lose there.");
    }
    const int vertices = study.clean->mesh().vertex_count();
    if (2 * study.feature_vertices > vertices) {
        return report::text(std::to_string(study.feature_vertices), " of the ", std::to_string(vertices), " vertices of ", study.name(),
                            " lie on edges sharper than 40°: on so coarse a mesh features and tessellation cannot be told apart.");
    }
    double lowest = INFINITY, highest = 0;
    for (const DenoisingTrial& trial : study.trials) {
        if (trial.best_rms == 0) continue;
        lowest = std::min(lowest, trial.feature_rms / trial.smooth_rms);
        highest = std::max(highest, trial.feature_rms / trial.smooth_rms);
    }
    if (highest == 0) return {};
    report::Text t = report::text("Of its ", std::to_string(vertices), " vertices ", std::to_string(study.feature_vertices),
                                  " lie on edges sharper than 40°; at the best iterations the error there is ", readable(lowest, 3));
    if (highest > lowest) report::extend(t, " to ", readable(highest, 3));
    report::extend(t, " times that elsewhere",
                   highest > 1.2  ? ": the filter cannot tell an edge from noise, and rounds it."
                   : lowest > 0.9 ? ": edges fare no worse than the rest."
                                  : ": edges fare better than the rest here.");
    return t;
}

report::Text position_against_normals(const DenoisingStudy& study) {
    for (const DenoisingTrial& trial : study.trials) {
        if (std::abs(trial.best_angle - trial.best_rms) < 3) continue;
        return report::text("Position and normals disagree about when to stop: at σ = ", readable_percent(trial.relative, 2),
                            " the rms error of ", study.name(), " is smallest at iteration ", std::to_string(trial.best_rms),
                            ", the angle between face normals at iteration ", std::to_string(trial.best_angle),
                            trial.best_angle == trial.iterations() ? " or later" : "", ".");
    }
    return {};
}

/// Above which noise, measured in mean edges, the gain reaches 1.2: a clean split of the cases or none.
report::Text limit_in_mean_edges(const std::vector<DenoisingStudy>& studies) {
    const auto [smallest_helped, largest_failed] = noise_split(studies);
    if (!std::isfinite(smallest_helped) || largest_failed == 0) return {};
    if (largest_failed < smallest_helped) {
        return report::text(" Measured in mean edges the cases split cleanly: every σ up to ", readable(largest_failed, 2),
                            " gains less than 1.2, every one from ", readable(smallest_helped, 2), " on gains more.");
    }
    return report::text(" Noise in mean edges does not decide alone: a gain of 1.2 was reached from ", readable(smallest_helped, 2),
                        " mean edges on, but missed at up to ", readable(largest_failed, 2), ".");
}

report::Text verdict(const std::vector<DenoisingStudy>& studies) {
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
    report::extend(t, " The two curves of ", math("bias"), " and ", math("noise"),
                   " explain it: smoothing removes noise at a rate set by λ and the operator, and shape at a "
                   "rate set by the shape; it pays as long as the noise is larger than what the same iterations take from the clean mesh (",
                   ref("q7_results"),
                   "). Where the minimum is expected to be beside where it is measured, and how it is found without the "
                   "clean mesh, is in ",
                   ref("prediction"), ". Seven other methods, and other kinds of noise, are tried in ", ref("methods"), ".");
    return t;
}

}   // namespace

void add_denoising_discussion(report::Section& section, const std::vector<DenoisingStudy>& studies) {
    add_heading(section, "Discussion: when does it work, when does it fail?");
    add_paragraphs(section, {verdict(studies)});
    for (const DenoisingStudy& study : studies) {
        add_paragraphs(section, {what_happened(study), features_pay(study), position_against_normals(study)});
    }
}

}   // namespace meshfolio
