// Tables, plots and checks of question 4 about the uses of the modes.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

using report::check_at_most;
constexpr auto smallest = report::Column::Best::smallest;

double percent_of(const SpectralStudy& study) { return 100 / study.diagonal; }

double wavelength(const SpectralStudy& study, int mode) { return 2 * M_PI / std::sqrt(study.spectrum.eigenvalues[mode - 1]); }

report::Series line_of(const std::string& name) { return {name, {}, {}, {}, {}, report::Series::Style::line_and_points}; }

}   // namespace

void add_threshold_table(report::Section& section, const SpectralStudy& study) {
    report::Table table;
    table.id = id_of("q4", study.name(), "thresholds");
    table.caption = "Smallest number of modes of " + study.name() +
                    " for a given error, out of all k: area-weighted rms, predicted by Parseval and measured on the mesh rebuilt with that "
                    "k. The last column is the shortest wavelength in use.";
    table.columns = {{"target", "% of box", 3},        {"smallest k", "", 6},           {"share of all modes", "%", 3},
                     {"predicted rms", "% of box", 5}, {"measured rms", "% of box", 5}, {"wavelength", "mean edges", 3}};
    for (const double share : {0.1, 0.01, 0.001}) {
        const int k = smallest_k_below(study, share);
        if (k == 0) continue;
        const Positions off = reconstruct(study.spectrum, study.laplacian.M, study.mesh().X, k) - study.mesh().X;
        const double measured = std::sqrt(study.laplacian.M.dot(off.rowwise().squaredNorm()) / study.laplacian.M.sum());
        const double mu = study.spectrum.eigenvalues[k - 1];
        table.rows.push_back({100 * share, double(k), 100.0 * k / study.vertices(), percent_of(study) * study.rms[k],
                              percent_of(study) * measured,
                              cell_of(wavelength(study, k) / study.source->prepared->preflight.mean_edge, mu > 0)});
        section.checks.push_back(
            check_at_most("rms predicted = measured at k = " + std::to_string(k) + ": difference / box diagonal on " + study.name(), 0,
                          std::abs(measured - study.rms[k]) / study.diagonal, 1e-9));
    }
    if (!table.rows.empty()) section.blocks.push_back(std::move(table));
}

void add_cost_table(report::Section& section, const SpectralStudy& study, const SpectralUses& uses) {
    report::Table table;
    table.id = id_of("q4", study.name(), "cost");
    table.caption = "What k modes of " + study.name() + " cost at least, counted, by any Krylov method: k solves with a factor of " +
                    readable(uses.factor_entries, 4) +
                    " entries, each vector orthogonalised once against all before it. Rebuilding the mesh is all that k costs once the "
                    "modes are there.";
    table.columns = {{"k", "", 6}, {"solves", "Mflop", 3}, {"orthogonalisation", "Mflop", 3}, {"rebuilding", "Mflop", 3}, {"Φ", "MiB", 3}};
    for (const Reconstruction& r : study.reconstructions) {
        const ModeCost cost = mode_cost(r.k, study.vertices(), uses.factor_entries);
        table.rows.push_back({double(r.k), 1e-6 * cost.solve_operations, 1e-6 * cost.orthogonalise_operations,
                              1e-6 * cost.rebuild_operations, cost.megabytes});
    }
    section.blocks.push_back(std::move(table));
}

void add_limb_table(report::Section& section, const SpectralStudy& study, const LimbStudy& limbs) {
    if (!limbs.measured()) return;
    report::Table table;
    table.id = id_of("q4", study.name(), "limbs");
    table.caption = "Where the error of " + study.name() +
                    " sits: area-weighted rms on the thinnest quarter of its area, median thickness " + readable(limbs.thin_diameter) +
                    ", and on the thickest, " + readable(limbs.thick_diameter) +
                    "; the share of the squared error on the tenth of the area that is farthest from the centroid; and Spearman's "
                    "correlation between thickness and error.";
    table.columns = {{"k", "", 6},
                     {"wavelength / thin girth", "", 3},
                     {"rms, thinnest quarter", "% of box", 3},
                     {"rms, thickest quarter", "% of box", 3},
                     {"thin / thick", "", 3},
                     {"error on the farthest tenth", "%", 3},
                     {"rank correlation", "", 2}};
    for (const LimbErrors& row : limbs.errors) {
        const bool wave = study.spectrum.eigenvalues[row.k - 1] > 0;
        table.rows.push_back({double(row.k), cell_of(wavelength(study, row.k) / (M_PI * limbs.thin_diameter), wave),
                              percent_of(study) * row.thin, percent_of(study) * row.thick, row.thin / row.thick, 100 * row.far_share,
                              row.rank_correlation});
    }
    section.blocks.push_back(std::move(table));
}

void add_low_pass_blocks(report::Section& section, const SpectralStudy& study, const LowPassStudy& low_pass) {
    if (low_pass.k == 0) return;
    report::Table table;
    table.id = id_of("q4", study.name(), "low_pass");
    table.caption = "Low-pass of " + study.name() + " without eigenvectors: polynomials of the operator, cutoff " +
                    readable(low_pass.cutoff, 4) + " 1/length² behind mode " + std::to_string(low_pass.k) +
                    ", on a spectrum proved to end below " + readable(low_pass.bound, 4) +
                    " 1/length². Area-weighted rms distance to the exact filter made of modes: the projection for the damped step, "
                    "exp(−ln 2 (μ/μ_c)²) for the smooth one.";
    table.columns = {{"degree = products with C", "", 6},
                     {"work", "Mflop", 3},
                     {"step: error", "% of box", 3, smallest},
                     {"step: predicted from known modes", "% of box", 3},
                     {"smooth: error", "% of box", 3, smallest}};
    report::Plot plot;
    plot.id = id_of("q4", study.name(), "low_pass_error");
    plot.x_label = "degree of the polynomial";
    plot.y_label = "rms distance to the exact filter [% of box diagonal]";
    plot.log_x = plot.log_y = true;
    report::Series step = line_of("damped step, to the projection on " + std::to_string(low_pass.k) + " modes"),
                   smooth = line_of("smooth response, to the same with exact modes");
    const double percent = percent_of(study);
    for (const LowPassError& row : low_pass.errors) {
        table.rows.push_back(
            {double(row.degree), 1e-6 * row.operations, percent * row.ideal, percent * row.ideal_from_response, percent * row.smooth});
        step.x.push_back(row.degree);
        step.y.push_back(percent * row.ideal);
        smooth.x.push_back(row.degree);
        smooth.y.push_back(row.smooth > 0 ? percent * row.smooth : std::nan(""));
    }
    const LowPassError &first = low_pass.errors.front(), &last = low_pass.errors.back();
    plot.caption = "Low-pass of " + study.name() + " by products with C alone. From degree " + std::to_string(first.degree) + " to " +
                   std::to_string(last.degree) + " the error of the damped step goes from " + readable(percent * first.ideal) + " to " +
                   readable(percent * last.ideal) + "\u202f% of the box diagonal, that of the smooth response from " +
                   readable(percent * first.smooth) + " to " + readable(percent * last.smooth) + "\u202f%.";
    plot.alt = plot.caption;
    plot.series = {std::move(step), std::move(smooth)};
    section.blocks.push_back(std::move(table));
    section.blocks.push_back(std::move(plot));
}

void add_band_table(report::Section& section, const SpectralStudy& study, const BandStudy& bands) {
    if (bands.bands.empty()) return;
    report::Table table;
    table.id = id_of("q4", study.name(), "band_energies");
    table.caption = "The bands of " + study.name() +
                    ": their modes, the wavelengths these end at, and their share of the energy Σ|ĉ|² that the known modes have beyond the "
                    "position of the mesh.";
    table.columns = {{"band", "", 3},
                     {"first mode", "", 6},
                     {"last mode", "", 6},
                     {"longest wavelength", "% of box", 3},
                     {"shortest wavelength", "% of box", 3},
                     {"energy", "%", 3}};
    for (const Band& band : bands.bands) {
        table.rows.push_back({band.name, double(band.first), double(band.last), percent_of(study) * wavelength(study, band.first),
                              percent_of(study) * wavelength(study, band.last), 100 * band.energy_share});
    }
    section.blocks.push_back(std::move(table));
    report::Table filters;
    filters.id = id_of("q4", study.name(), "filters");
    filters.caption = "How far each filter moves " + study.name() +
                      ", area-weighted rms: predicted from gains and coefficients, and measured. Gains "
                      "pass from band to band over half an octave of wavelength; only the low-pass is sharp.";
    filters.columns = {{"filter", "", 3}, {"predicted", "% of box", 5}, {"measured", "% of box", 5}, {"largest", "% of box", 3}};
    for (const EqualisedMesh& state : bands.meshes) {
        filters.rows.push_back({state.label, percent_of(study) * state.predicted_rms, percent_of(study) * state.measured_rms,
                                percent_of(study) * state.distance.maxCoeff()});
    }
    section.blocks.push_back(std::move(filters));
}

void add_mistake_table(report::Section& section, const SpectralStudy& study, const MistakeStudy& mistakes) {
    report::Table table;
    table.id = id_of("q4", study.name(), "errors_mistaken");
    table.caption = "rms error over the vertices of " + study.name() +
                    " rebuilt the right way and three mistaken ones: ψ = √M φ not mapped back, plain products with M-normalised modes, "
                    "and the operator normalised per edge, (cot α + cot β)/(Aᵢ + Aⱼ), with plain products.";
    table.columns = {
        {"k", "", 6}, {"Φ ΦᵀMX", "% of box", 3}, {"Ψ ΨᵀX", "% of box", 3}, {"Φ ΦᵀX", "% of box", 3}, {"edge-normalised", "% of box", 3}};
    const double percent = percent_of(study);
    for (const MistakeErrors& row : mistakes.errors) {
        table.rows.push_back(
            {double(row.k), percent * row.right, percent * row.unmapped, percent * row.unweighted, cell_of(percent * row.edge_normalised)});
    }
    section.blocks.push_back(std::move(table));
}

std::vector<report::Check> spectral_use_checks(const SpectralStudy& study, const SpectralUses& uses) {
    std::vector<report::Check> checks;
    const std::string on = " on " + study.name();
    double gap = 0;
    for (const EqualisedMesh& state : uses.bands.meshes) gap = std::max(gap, std::abs(state.predicted_rms - state.measured_rms));
    if (!uses.bands.meshes.empty()) {
        checks.push_back(
            check_at_most("filters move the mesh as their gains predict: difference / box diagonal" + on, 0, gap / study.diagonal, 1e-9));
    }
    if (uses.low_pass.k == 0) return checks;
    double excess = 0;
    for (const LowPassError& row : uses.low_pass.errors) excess = std::max(excess, row.ideal_from_response - row.ideal);
    checks.push_back(check_at_most("low-pass by products: part of the known modes − whole error, / box diagonal" + on, 0,
                                   excess / study.diagonal, 1e-9));
    const LowPassError &first = uses.low_pass.errors.front(), &last = uses.low_pass.errors.back();
    if (last.degree < 15 * std::sqrt(uses.low_pass.bound / uses.low_pass.cutoff)) return checks;
    // From this degree on the passage of the step is narrow, and the series of the smooth response has converged.
    checks.push_back(check_at_most("low-pass by products: error at the highest / at the lowest degree" + on, 1, last.ideal / first.ideal));
    checks.push_back(
        check_at_most("smooth low-pass by products = by modes: (difference − what the modes not computed can add) / box diagonal" + on, 0,
                      (last.smooth - uses.low_pass.unknown) / study.diagonal, 1e-8));
    return checks;
}

}   // namespace meshfolio::q4_spectral
