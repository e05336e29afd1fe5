// What the numbers of question 4 say.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

using report::math;
using report::ref;

report::Text answer_to_larger_k(const SpectralStudy& study) {
    const Reconstruction& first = study.reconstructions.front();
    const Reconstruction& last = study.reconstructions.back();
    const double percent = 100 / study.diagonal;
    if (study.reconstructions.size() == 1) {
        return report::text("On ", study.name(), " k = ", std::to_string(first.k), " leaves an rms error of ",
                            readable(percent * first.difference.rms),
                            "\u202f% of the box diagonal; one k alone cannot say whether more is better, but ",
                            ref(id_of("q4", study.name(), "error_versus_k")), " covers every smaller k.");
    }
    report::Text t = report::text(
        "Yes, on ", study.name(), " every further eigenvector lowers the error (", ref(id_of("q4", study.name(), "error_versus_k")),
        "), as it must for an M-orthogonal projection: weighted by area from ", readable(percent * study.rms[first.k]),
        "\u202f% of the box diagonal at k = ", std::to_string(first.k), " to ",
        study.rms[last.k] < 1e-9 * study.diagonal ? std::string("rounding") : readable(percent * study.rms[last.k]) + "\u202f%",
        " at k = ", std::to_string(last.k), ".");
    std::vector<std::string> steps, beyond;
    for (const double share : {0.1, 0.01, 0.001}) {
        const int k = smallest_k_below(study, share);
        if (k > 0) {
            steps.push_back(std::to_string(k) + " for " + readable_percent(share, 1));
        } else {
            beyond.push_back(readable_percent(share, 1));
        }
    }
    if (!steps.empty()) report::extend(t, " It takes k = ", listed(steps), " of the diagonal.");
    if (!beyond.empty())
        report::extend(t, " An error of ", listed(beyond), " is not reached with the ", std::to_string(study.modes()), " modes computed.");
    return t;
}

/// The error falls like k^−p between two k: the gain that doubling k still brings.
report::Text diminishing_returns(const SpectralStudy& study) {
    const int end = study.modes();
    const int low = std::max(2, study.reconstructions.front().k), middle = std::max(low + 1, end / 8), high = std::max(middle + 1, end / 2);
    if (high > end || !(study.rms[high] > 1e-12 * study.diagonal)) return {};
    const double early = falling_power(study, low, middle), late = falling_power(study, middle, high);
    return report::text(
        "Between k = ", std::to_string(low), " and ", std::to_string(middle), " the rms error falls like ", math("k"),
        " to the power \u2212", readable(early, 2), ", between ", std::to_string(middle), " and ", std::to_string(high), " like \u2212",
        readable(late, 2), ": doubling k there divides the error by ", readable(std::pow(2, late), 2), ", from k = ", std::to_string(high),
        " to ", std::to_string(end), " it falls ",
        study.rms[end] < 1e-9 * study.diagonal ? "to rounding" : "by a factor of " + readable(study.rms[high] / study.rms[end], 2),
        ". Each mode of wavelength ", math("2π/√μ"), " carries the detail of that size; the shortest wavelength in use is ",
        readable(2 * M_PI / std::sqrt(study.spectrum.eigenvalues[end - 1])), ", ",
        readable(2 * M_PI / std::sqrt(study.spectrum.eigenvalues[end - 1]) / study.source->prepared->preflight.mean_edge, 2),
        " mean edges.");
}

report::Text where_the_error_sits(const SpectralStudy& study) {
    const auto is_informative = [&](const Reconstruction& r) { return r.difference.rms > 1e-3 * study.diagonal; };
    const auto it = std::find_if(study.reconstructions.rbegin(), study.reconstructions.rend(), is_informative);
    if (it == study.reconstructions.rend()) return {};
    const double remoteness = remoteness_of_worst(study, *it);
    const MeshDifference& d = it->difference;
    report::Text t = report::text("At k = ", std::to_string(it->k), " the 5\u202f% of vertices that are farthest off lie at ",
                                  readable(remoteness, 2), " times the mean distance from the centroid");
    if (remoteness > 1.15) {
        report::extend(t, ": they lie farther out than the mean, towards the extremities");
    } else if (remoteness < 0.85) {
        report::extend(t, ": they lie farther in than the mean, away from the extremities");
    } else {
        report::extend(t, ": the largest errors are not tied to the extremities");
    }
    report::extend(t, " (largest error ", readable(d.max / d.rms, 2), " times the rms).");
    if (std::isfinite(d.volume_ratio) && study.source->prepared->preflight.closed()) {
        report::extend(t, " The enclosed volume there is ", readable(100 * d.volume_ratio, 3), "\u202f% of the original.");
    }
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<SpectralStudy>& studies, const std::vector<SpectralUses>& uses) {
    add_heading(section, "Discussion: does a larger k give better reconstructions?");
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const SpectralStudy& study = studies[i];
        add_paragraphs(section, {answer_to_larger_k(study), diminishing_returns(study), where_the_error_sits(study),
                                 thin_parts(study, uses[i].limbs), cost_of_large_k(study, uses[i]), what_bands_do(study, uses[i].bands),
                                 low_pass_without_modes(study, uses[i]), cost_of_mistakes(study, uses[i].mistakes)});
    }
}

}   // namespace meshfolio::q4_spectral
