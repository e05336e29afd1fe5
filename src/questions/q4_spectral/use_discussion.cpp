// What the numbers of question 4 say about cost, thin parts, bands, low-passes and mistakes.
#include "questions/q4_spectral/parts.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"

namespace meshfolio::q4_spectral {

using report::math;
using report::ref;

namespace {

std::string percent_of_box(const SpectralStudy& study, double length, int digits = 3) {
    return readable(100 * length / study.diagonal, digits) + "\u202f%";
}

/// "3.2 Mflop", "1.5 Gflop".
std::string work(double operations) {
    return operations < 1e9 ? readable(1e-6 * operations) + "\u202fMflop" : readable(1e-9 * operations) + "\u202fGflop";
}

/// "0.98 to 1.2".
std::string edge_normalised_range(const MistakeStudy& mistakes) {
    double low = INFINITY, high = 0;
    for (const MistakeErrors& row : mistakes.errors) {
        if (!std::isfinite(row.edge_normalised) || !(row.right > 0)) continue;
        low = std::min(low, row.edge_normalised / row.right);
        high = std::max(high, row.edge_normalised / row.right);
    }
    return readable(low) + " to " + readable(high);
}

}   // namespace

report::Text cost_of_large_k(const SpectralStudy& study, const SpectralUses& uses) {
    const ModeCost cost = mode_cost(study.reconstructions.back().k, study.vertices(), uses.factor_entries);
    const double crossing = 2 * uses.factor_entries / study.vertices();
    report::Text t = report::text("What a large k costs is its modes: ", std::to_string(cost.k), " of them are ", readable(cost.megabytes),
                                  " MiB, and to rebuild ", study.name(), " from them takes ", work(cost.rebuild_operations), ".");
    if (study.spectrum.dense) {
        report::extend(t,
                       " Here all eigenvectors were computed at once by a dense solver, whose reduction to tridiagonal form alone takes ",
                       math("4n³/3"), ", ", work(4.0 / 3 * std::pow(study.vertices(), 3)), ", whatever k.");
        return t;
    }
    report::extend(t, " To find them takes at least ", work(cost.solve_operations), " of solves, which grow like k, and ",
                   work(cost.orthogonalise_operations),
                   " of orthogonalisation, which grows like k²: on this mesh the second is the larger from k = ",
                   std::to_string(static_cast<int>(std::ceil(crossing))), " on (", ref(id_of("q4", study.name(), "cost")), ").");
    return t;
}

report::Text thin_parts(const SpectralStudy& study, const LimbStudy& limbs) {
    if (!limbs.measured()) return {};
    const LimbErrors& row = limbs.errors[limbs.errors.size() > 1 ? 1 : 0];
    const double ratio = row.thin / row.thick;
    report::Text t = report::text("At k = ", std::to_string(row.k), " the rms error on the thinnest quarter of the area is ",
                                  percent_of_box(study, row.thin), " of the box diagonal, on the thickest ",
                                  percent_of_box(study, row.thick), " (", ref(id_of("q4", study.name(), "limbs")), ").");
    report::extend(t,
                   " To give a limb of diameter d its round cross-section a mode must go once round it, which takes the wavelength πd, or ",
                   math("μ ≥ 4/d²"), ". For the thin quarter, d = ", readable(limbs.thin_diameter), ", ");
    if (limbs.modes_needed > 0) {
        report::extend(t, "the first such mode is number ", std::to_string(limbs.modes_needed), " of ", std::to_string(study.vertices()),
                       ".");
    } else {
        report::extend(t, "no such mode is among the ", std::to_string(study.modes()), " computed.");
    }
    const bool missing = limbs.modes_needed == 0 || limbs.modes_needed > row.k;
    if (missing && ratio > 1.1) {
        report::extend(t, " The bands that would carry it are missing at k = ", std::to_string(row.k),
                       ": thin limbs shrink to their axes and appear as ghosts, ", readable(ratio, 2), " times as far off as the trunk.");
    } else if (missing) {
        report::extend(t, " These bands are missing at k = ", std::to_string(row.k),
                       ", but here the thin parts are no farther off than the thick ones (", readable(ratio, 2), " times).");
    } else {
        report::extend(t, " At k = ", std::to_string(row.k), " such modes are in use.");
    }
    const LimbErrors& last = limbs.errors.back();
    if (limbs.modes_needed > 0 && last.k > std::max(row.k, limbs.modes_needed)) {
        const double later = last.thin / last.thick;
        report::extend(t, " At k = ", std::to_string(last.k), ", with the first of these modes in use, the ratio is ", readable(later, 2),
                       later > 1.1 ? ": one way round a limb is not yet its shape." : ".");
    }
    report::extend(t, " At k = ", std::to_string(row.k), " the tenth of the area that is farthest from the centroid holds ",
                   readable_percent(row.far_share), " of the squared error.");
    return t;
}

report::Text what_bands_do(const SpectralStudy& study, const BandStudy& bands) {
    if (bands.bands.empty()) return {};
    const auto largest = std::max_element(bands.bands.begin(), bands.bands.end(),
                                          [](const Band& a, const Band& b) { return a.energy_share < b.energy_share; });
    report::Text t = report::text("Of the energy of ", study.name(), " in its frequencies, ", readable(100 * largest->energy_share),
                                  "\u202f% is in the ", largest->name, " band, modes ", std::to_string(largest->first), " to ",
                                  std::to_string(largest->last), ".");
    report::extend(t, " Amplified (", ref(id_of("q4", study.name(), "bands")), "), the bands move the surface by ");
    std::vector<std::string> parts;
    for (const EqualisedMesh& state : bands.meshes) {
        if (state.id.ends_with("_up"))
            parts.push_back(percent_of_box(study, state.measured_rms) + " of the box diagonal (" + state.label + ")");
    }
    report::extend(t, listed(parts), ".");
    return t;
}

report::Text low_pass_without_modes(const SpectralStudy& study, const SpectralUses& uses) {
    const LowPassStudy& low_pass = uses.low_pass;
    if (low_pass.k == 0) return {};
    const LowPassError& last = low_pass.errors.back();
    const auto good = std::find_if(low_pass.errors.begin(), low_pass.errors.end(),
                                   [&](const LowPassError& row) { return row.smooth <= 1e-4 * study.diagonal; });
    report::Text t = report::text("A low-pass without eigenvectors: ");
    if (good != low_pass.errors.end()) {
        report::extend(t, "a polynomial of degree ", std::to_string(good->degree), ", ", work(good->operations),
                       ", applies the smooth response to ", percent_of_box(study, good->smooth, 2), " of the box diagonal");
    } else {
        report::extend(t, "a polynomial of degree ", std::to_string(last.degree), ", ", work(last.operations), ", still is ",
                       percent_of_box(study, last.smooth, 2), " of the box diagonal from the smooth response");
    }
    report::extend(t, "; the jump behind mode ", std::to_string(low_pass.k), " is met only as far as degree ", std::to_string(last.degree),
                   " brings it, ", percent_of_box(study, last.ideal, 2), " (", ref(id_of("q4", study.name(), "low_pass_error")), ").");
    const auto worst = std::max_element(low_pass.errors.begin(), low_pass.errors.end(),
                                        [](const LowPassError& a, const LowPassError& b) { return a.ideal < b.ideal; });
    if (worst != low_pass.errors.begin()) {
        report::extend(t, " At degree ", std::to_string(worst->degree),
                       " the error of the step is still the largest: its transition is wider than its pass band.");
    }
    report::extend(t, " What limits both is the spectrum's length: its bound is ", readable(low_pass.bound / low_pass.cutoff),
                   " times the cutoff, and a degree d tells apart what is about 1/d² of the bound.");
    if (!study.spectrum.dense) {
        const ModeCost cost = mode_cost(low_pass.k, study.vertices(), uses.factor_entries);
        const LowPassError& told = good != low_pass.errors.end() ? *good : last;
        const double ratio = told.operations / (cost.solve_operations + cost.orthogonalise_operations);
        report::extend(t, " Degree ", std::to_string(told.degree), " takes ", readable(ratio, 2), " times the operations that the first ",
                       std::to_string(low_pass.k),
                       " modes take at least, not counting the factorisation, which the polynomial does not need.");
    }
    return t;
}

report::Text cost_of_mistakes(const SpectralStudy& study, const MistakeStudy& mistakes) {
    const auto at =
        std::find_if(mistakes.errors.begin(), mistakes.errors.end(), [&](const MistakeErrors& row) { return row.k == mistakes.pictured; });
    if (at == mistakes.errors.end()) return {};
    report::Text t = report::text("With k = ", std::to_string(at->k), " the right way is ", percent_of_box(study, at->right),
                                  " of the box diagonal off, rms over the vertices of ", study.name(), "; with ψ not mapped back it is ",
                                  percent_of_box(study, at->unmapped), ", with plain products of M-normalised modes ",
                                  percent_of_box(study, at->unweighted), ", a number that changes with the unit of length.");
    if (std::isfinite(at->edge_normalised)) {
        report::extend(t, " The operator normalised per edge, a consistent projection on other modes, is ",
                       percent_of_box(study, at->edge_normalised), " off, and from ", edge_normalised_range(mistakes),
                       " times as far as the right one over the k of the table.");
    }
    report::extend(t, " ", ref(id_of("q4", study.name(), "errors_mistaken")), " has them all.");
    return t;
}

}   // namespace meshfolio::q4_spectral
