// Claims about the operator itself and about meshes rebuilt from its smoothest modes.
#include "geometry/measures/mesh_laws.h"
#include "questions/bench/spectral_study.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

SparseMatrix L_of(const LaplaceBeltrami& laplacian) {
    Vector inverse = laplacian.M;
    for (double& a : inverse) a = a > 0 ? 1 / a : 0;
    return inverse.asDiagonal() * laplacian.C;
}

Measurement C_not_symmetric(ClaimBench& bench, const MeshNames&) {
    const LaplaceBeltrami& laplacian = bench.subject("bunny").laplacian;
    const double of_L = asymmetry(L_of(laplacian));
    return {.cases = {{"C", asymmetry(laplacian.C)}},
            .remark = of_L > 1e-9 ? words.say("claims_s1_symmetric.remark", "asymmetry"_a = readable(of_L, 2)) : report::Text()};
}

Measurement L_not_symmetric(ClaimBench& bench, const MeshNames&) {
    return {.cases = {{"L = M⁻¹C", asymmetry(L_of(bench.subject("bunny").laplacian))}}};
}

Case clamped_limit(ClaimBench& bench, std::string_view name) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const double clamped = largest_stable_step(largest_eigenvalue(laplace_operator(source.mesh(), OperatorKind::clamped)));
    return {source.name, clamped / bench.subject(name).critical};
}

std::string k_text(int k) { return "k = " + std::to_string(k); }

/// Error of k modes, or of all modes of the mesh if it has fewer. [% of the box diagonal]
double error_at(const SpectralStudy& study, int k) { return 100 * study.rms[std::min(k, study.modes())] / study.diagonal; }

template <int k> Case error_of_modes(ClaimBench& bench, std::string_view name) {
    const SpectralStudy& study = bench.spectrum(name);
    return {study.name() + ", " + k_text(std::min(k, study.modes())), error_at(study, k)};
}

Measurement near_original(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m = Measure(error_of_modes<150>)(bench, meshes);
    const SpectralStudy& first = bench.spectrum(meshes.front());
    report::Plot plot{.id = "claims_modes",
                      .caption = words.line("plot.modes", "error"_a = readable(m.cases.front().value, 2),
                                            "modes"_a = std::min(150, first.modes()), "mesh"_a = first.name()),
                      .x_label = "number of modes k",
                      .y_label = "rms error [% of the box diagonal]",
                      .log_x = true,
                      .log_y = true,
                      .vertical_lines = {{5, "k = 5"}, {30, "k = 30"}, {150, "k = 150"}}};
    for (const std::string_view name : meshes) {
        const SpectralStudy& study = bench.spectrum(name);
        report::Series series{.name = study.name()};
        for (int k = 1; k <= study.modes(); ++k) add_point(series, k, error_at(study, k));
        plot.series.push_back(std::move(series));
    }
    m.figure = plot.id;
    bench.plots.push_back(std::move(plot));
    return m;
}

Measurement more_is_better(ClaimBench& bench, const MeshNames&) {
    const SpectralStudy& study = bench.spectrum("cow");
    Measurement m{.remarked = true};
    for (const auto& [before, k] : {std::pair{5, 10}, std::pair{10, 30}, std::pair{30, 150}})
        m.cases.push_back({k_text(k) + " after " + std::to_string(before), error_at(study, k) / error_at(study, before)});
    return m;
}

Measurement hands_and_feet(ClaimBench& bench, const MeshNames&) {
    Measurement m{.remarked = true};
    const SpectralStudy& study = bench.spectrum("armadillo");
    for (const int k : {5, 15, 30}) {
        const auto r = std::ranges::find(study.reconstructions, k, &Reconstruction::k);
        if (r != study.reconstructions.end() && r->predicted_rms > 1e-9 * study.diagonal)
            m.cases.push_back({k_text(k), remoteness_of_worst(study, *r)});
    }
    return m;
}

Measurement normalised_by_edges(ClaimBench& bench, const MeshNames&) {
    Measurement m{.remarked = true};
    const SpectralStudy& study = bench.spectrum("armadillo");
    for (const MistakeErrors& e : mistake_study(study, !bench.settings().laboratory))
        if (e.right > 1e-9 * study.diagonal) m.cases.push_back({k_text(e.k), e.edge_normalised / e.right});
    return m;
}

Measurement projection_needs_areas(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    for (const MistakeErrors& e : mistake_study(bench.spectrum("armadillo"), true)) {
        if (e.k != 15 && e.k != 5) continue;
        m.cases.push_back({words.line("claims_vallet_projection.case.unmapped", "k"_a = e.k), e.unmapped / e.right});
        m.cases.push_back({words.line("claims_vallet_projection.case.unweighted", "k"_a = e.k), e.unweighted / e.right});
    }
    return m;
}

constexpr std::string_view of_diagonal = "% of the box diagonal";
const About with_negative_weights{{"armadillo", "lilium", "plane_ns"}, {negative_weights}};

}   // namespace

extern const std::vector<Claim> spectral_claims{
    {"claims_s1_symmetric", "q4", {{"bunny"}}, {"asymmetry_c", "", at_least, 1e-9}, C_not_symmetric},
    {"claims_s2_symmetric", "q4", {{"bunny"}, {unequal_areas}}, {"asymmetry_l", "", at_least, 1e-3}, L_not_symmetric},
    {"claims_s3_clamp_stable", "q4", with_negative_weights, {"clamped_limit", "", at_least, 1.01}, remarked(clamped_limit), full},
    {"claims_s1_k150", "q4", {{"bunny", "cow"}, {above_1500_vertices}}, {"rebuilt", of_diagonal, at_most, 1}, near_original, full},
    {"claims_s1_more_modes", "q4", {{"cow"}, {above_1500_vertices}}, {"next_k", "", at_most, 0.95}, more_is_better, full},
    {"claims_s2_k30", "q4", {{"bumpy_cube"}, {}, itself}, {"rebuilt", of_diagonal, at_least, 0.5}, error_of_modes<30>, full},
    {"claims_s2_k130", "q4", {{"bumpy_cube"}, {}, itself}, {"rebuilt", of_diagonal, at_most, 1}, error_of_modes<130>, full},
    {"claims_s3_hands_feet", "q4", {{"armadillo"}, {}, its_kind}, {"remoteness", "", at_least, 1.2}, hands_and_feet, full},
    {"claims_s3_edge_areas", "q4", {{"armadillo"}}, {"edge_normalised", "", at_most, 0.99}, normalised_by_edges, full},
    {"claims_vallet_projection", "q4", {{"armadillo"}, {unequal_areas}}, {"either_step", "", at_least, 1}, projection_needs_areas, full}};

}   // namespace meshfolio::claims
