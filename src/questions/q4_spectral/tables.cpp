#include "geometry/spectrum/spectral_reconstruction.h"
#include "questions/core/table.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

constexpr auto count_digits = 6;

/// A length of each element, as a share of the box.
auto of_box(const SpectralStudy& study, auto length_of) {
    return [percent = percent_of(study), length_of](auto& element) { return cell_of(percent * std::invoke(length_of, element)); };
}

void add_point(report::Series& series, double x, double y) {
    series.x.push_back(x);
    series.y.push_back(y);
}

}   // namespace

std::vector<Threshold> thresholds_of(const SpectralStudy& study) {
    const Vector& M = study.laplacian.M;
    std::vector<Threshold> reached;
    for (const double share : target_shares) {
        const int k = smallest_k_below(study, share);
        if (k == 0) continue;
        const Positions off = reconstruct(study.spectrum, M, study.mesh().X, k) - study.mesh().X;
        reached.push_back({share, k, std::sqrt(M.dot(off.rowwise().squaredNorm()) / M.sum())});
    }
    return reached;
}

report::Table error_table(const SpectralStudy& study) {
    const report::Column share{.unit = "% of box", .best = smallest};
    return table(id_of(study, "errors"), words.line("errors", "mesh"_a = study.name(), "diagonal"_a = readable(study.diagonal, 4)),
                 study.reconstructions)
        .column("k", {.digits = count_digits}, &Reconstruction::k)
        .column("μ_k", {.unit = "1/length²", .digits = 4}, [&](auto& r) { return study.spectrum.eigenvalues[r.k - 1]; })
        .column("rms", {.unit = "length"}, [](auto& r) { return r.difference.rms; })
        .column("rms", share, of_box(study, [](auto& r) { return r.difference.rms; }))
        .column("maximum", share, of_box(study, [](auto& r) { return r.difference.max; }))
        .column("Hausdorff", share, of_box(study, [](auto& r) { return r.difference.hausdorff; }))
        .column("mean normal angle", {.unit = "°", .best = smallest}, [](auto& r) { return r.difference.mean_normal_angle * 180 / pi; })
        .column("volume", {.unit = "% of original", .digits = 4}, [](auto& r) { return cell_of(100 * r.difference.volume_ratio); });
}

report::Plot error_plot(const SpectralStudy& study) {
    const double percent = percent_of(study), rounding = 1e-9 * study.diagonal;   // below it, a logarithm would squeeze everything else
    report::Series predicted{.name = words.line("error_versus_k.predicted")};
    report::Series measured{.name = words.line("error_versus_k.measured"), .style = report::Series::Style::points};
    for (int k = 1; k <= study.modes() && study.rms[k] > rounding; ++k) add_point(predicted, k, percent * study.rms[k]);
    for (const Reconstruction& r : study.reconstructions)
        if (r.difference.area_weighted_rms > rounding) add_point(measured, r.k, percent * r.difference.area_weighted_rms);
    report::Plot plot{.id = id_of(study, "error_versus_k"),
                      .caption = words.line("error_versus_k", "mesh"_a = study.name(), "modes"_a = study.modes()),
                      .alt = words.line("error_versus_k.alt", "first"_a = readable(percent * study.rms[1]),
                                        "last"_a = readable(percent * study.rms[study.modes()]), "modes"_a = study.modes()),
                      .x_label = "number of eigenvectors k",
                      .y_label = words.line("error_versus_k.y"),
                      .log_x = true,
                      .log_y = true,
                      .series = {std::move(predicted), std::move(measured)}};
    for (const double share : target_shares)
        if (const int k = smallest_k_below(study, share); k > 0)
            plot.markers.push_back({double(k), percent * study.rms[k], readable_percent(share, 1) + ": k = " + std::to_string(k)});
    return plot;
}

report::Table threshold_table(const SpectralStudy& study, const std::vector<Threshold>& thresholds) {
    const auto edges = [&](const Threshold& t) {
        return cell_of(wavelength(study, t.k) / study.source->prepared->preflight.mean_edge, study.spectrum.eigenvalues[t.k - 1] > 0);
    };
    return table(id_of(study, "thresholds"), words.line("thresholds", "mesh"_a = study.name()), thresholds)
        .column("target", {.unit = "% of box"}, [](auto& t) { return 100 * t.share; })
        .column("smallest k", {.digits = count_digits}, &Threshold::k)
        .column("share of all modes", {.unit = "%"}, [&](auto& t) { return 100.0 * t.k / study.vertices(); })
        .column("predicted rms", {.unit = "% of box", .digits = 5}, of_box(study, [&](auto& t) { return study.rms[t.k]; }))
        .column("measured rms", {.unit = "% of box", .digits = 5}, of_box(study, &Threshold::measured_rms))
        .column("wavelength", {.unit = "mean edges"}, edges);
}

report::Table eigenvalue_table(const SpectralStudy& study) {
    std::vector<int> shown;
    for (int i = 1; i <= study.modes(); ++i)
        if (i <= 10 || std::ranges::find(study.reconstructions, i, &Reconstruction::k) != study.reconstructions.end()) shown.push_back(i);
    const Vector& mu = study.spectrum.eigenvalues;
    return table(id_of(study, "eigenvalues"), words.line("eigenvalues", "mesh"_a = study.name()), shown)
        .column("index", {.digits = count_digits}, std::identity())
        .column("μ", {.unit = "1/length²", .digits = 6}, [&](int i) { return mu[i - 1]; })
        .column("residual", {.digits = 2}, [&](int i) { return study.spectrum.residuals[i - 1]; })
        .column("wavelength", {.unit = "length"}, [&](int i) { return cell_of(wavelength(study, i), mu[i - 1] > 0); });
}

report::Table limb_table(const SpectralStudy& study, const LimbStudy& limbs) {
    const auto round_a_limb = [&](const LimbErrors& row) {
        return cell_of(wavelength(study, row.k) / (pi * limbs.thin_diameter), study.spectrum.eigenvalues[row.k - 1] > 0);
    };
    return table(id_of(study, "limbs"),
                 words.line("limbs", "mesh"_a = study.name(), "thin"_a = readable(limbs.thin_diameter),
                            "thick"_a = readable(limbs.thick_diameter)),
                 limbs.errors)
        .column("k", {.digits = count_digits}, &LimbErrors::k)
        .column("wavelength / thin girth", round_a_limb)
        .column("rms, thinnest quarter", {.unit = "% of box"}, of_box(study, &LimbErrors::thin))
        .column("rms, thickest quarter", {.unit = "% of box"}, of_box(study, &LimbErrors::thick))
        .column("thin / thick", [](auto& row) { return row.thin / row.thick; })
        .column(words.line("limbs.farthest"), {.unit = "%"}, [](auto& row) { return 100 * row.far_share; })
        .column("rank correlation", {.digits = 2}, &LimbErrors::rank_correlation);
}

report::Table cost_table(const SpectralStudy& study, double factor_entries) {
    std::vector<ModeCost> costs;
    for (const Reconstruction& r : study.reconstructions) costs.push_back(mode_cost(r.k, study.vertices(), factor_entries));
    return table(id_of(study, "cost"), words.line("cost", "mesh"_a = study.name(), "entries"_a = readable(factor_entries, 4)), costs)
        .column("k", {.digits = count_digits}, &ModeCost::k)
        .column("solves", {.unit = "Mflop"}, [](auto& cost) { return 1e-6 * cost.solve_operations; })
        .column("orthogonalisation", {.unit = "Mflop"}, [](auto& cost) { return 1e-6 * cost.orthogonalise_operations; })
        .column("rebuilding", {.unit = "Mflop"}, [](auto& cost) { return 1e-6 * cost.rebuild_operations; })
        .column("Φ", {.unit = "MiB"}, &ModeCost::megabytes);
}

report::Table band_table(const SpectralStudy& study, const BandStudy& bands) {
    return table(id_of(study, "band_energies"), words.line("band_energies", "mesh"_a = study.name()), bands.bands)
        .column("band", &Band::name)
        .column("first mode", {.digits = count_digits}, &Band::first)
        .column("last mode", {.digits = count_digits}, &Band::last)
        .column("longest wavelength", {.unit = "% of box"}, of_box(study, [&](auto& band) { return wavelength(study, band.first); }))
        .column("shortest wavelength", {.unit = "% of box"}, of_box(study, [&](auto& band) { return wavelength(study, band.last); }))
        .column("energy", {.unit = "%"}, [](auto& band) { return 100 * band.energy_share; });
}

report::Table filter_table(const SpectralStudy& study, const BandStudy& bands) {
    return table(id_of(study, "filters"), words.line("filters", "mesh"_a = study.name()), bands.meshes)
        .column("filter", &EqualisedMesh::label)
        .column("predicted", {.unit = "% of box", .digits = 5}, of_box(study, &EqualisedMesh::predicted_rms))
        .column("measured", {.unit = "% of box", .digits = 5}, of_box(study, &EqualisedMesh::measured_rms))
        .column("largest", {.unit = "% of box"}, of_box(study, [](auto& state) { return state.distance.maxCoeff(); }));
}

report::Table low_pass_table(const SpectralStudy& study, const LowPassStudy& low_pass) {
    return table(id_of(study, "low_pass"),
                 words.line("low_pass", "mesh"_a = study.name(), "cutoff"_a = readable(low_pass.cutoff, 4), "k"_a = low_pass.k,
                            "bound"_a = readable(low_pass.bound, 4)),
                 low_pass.errors)
        .column(words.line("low_pass.degree"), {.digits = count_digits}, &LowPassError::degree)
        .column("work", {.unit = "Mflop"}, [](auto& row) { return 1e-6 * row.operations; })
        .column("step: error", {.unit = "% of box", .best = smallest}, of_box(study, &LowPassError::ideal))
        .column(words.line("low_pass.predicted"), {.unit = "% of box"}, of_box(study, &LowPassError::ideal_from_response))
        .column("smooth: error", {.unit = "% of box", .best = smallest}, of_box(study, &LowPassError::smooth));
}

report::Plot low_pass_plot(const SpectralStudy& study, const LowPassStudy& low_pass) {
    const double percent = percent_of(study);
    constexpr auto style = report::Series::Style::line_and_points;
    report::Series step{.name = words.line("low_pass_error.step", "k"_a = low_pass.k), .style = style};
    report::Series smooth{.name = words.line("low_pass_error.smooth"), .style = style};
    for (const LowPassError& row : low_pass.errors) {
        add_point(step, row.degree, percent * row.ideal);
        add_point(smooth, row.degree, row.smooth > 0 ? percent * row.smooth : undefined);
    }
    const LowPassError &first = low_pass.errors.front(), &last = low_pass.errors.back();
    report::Plot plot{
        .id = id_of(study, "low_pass_error"),
        .caption = words.line("low_pass_error", "mesh"_a = study.name(), "first"_a = first.degree, "last"_a = last.degree,
                              "step_first"_a = readable(percent * first.ideal), "step_last"_a = readable(percent * last.ideal),
                              "smooth_first"_a = readable(percent * first.smooth), "smooth_last"_a = readable(percent * last.smooth)),
        .x_label = "degree of the polynomial",
        .y_label = words.line("low_pass_error.y"),
        .log_x = true,
        .log_y = true,
        .series = {std::move(step), std::move(smooth)}};
    plot.alt = plot.caption;
    return plot;
}

report::Table mistake_table(const SpectralStudy& study, const MistakeStudy& mistakes) {
    return table(id_of(study, "errors_mistaken"), words.line("errors_mistaken", "mesh"_a = study.name()), mistakes.errors)
        .column("k", {.digits = count_digits}, &MistakeErrors::k)
        .column("Φ ΦᵀMX", {.unit = "% of box"}, of_box(study, &MistakeErrors::right))
        .column("Ψ ΨᵀX", {.unit = "% of box"}, of_box(study, &MistakeErrors::unmapped))
        .column("Φ ΦᵀX", {.unit = "% of box"}, of_box(study, &MistakeErrors::unweighted))
        .column("edge-normalised", {.unit = "% of box"}, of_box(study, &MistakeErrors::edge_normalised));
}

}   // namespace meshfolio::q4_spectral
