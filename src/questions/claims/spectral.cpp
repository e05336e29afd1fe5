// Claims about meshes rebuilt from their smoothest modes.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/bench/spectral_uses.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"

namespace meshfolio::claims {

namespace {

/// Error of k modes, fewer where the mesh has no more. [% of the box diagonal]
double error_at(const SpectralStudy& study, int k) { return 100 * study.rms[std::min(k, study.modes())] / study.diagonal; }

Measurement errors_at(ClaimBench& bench, const MeshNames& meshes, int k) {
    Measurement m;
    for (const std::string_view name : meshes) {
        const SpectralStudy& study = bench.spectrum(name);
        m.cases.push_back({study.name() + ", k = " + std::to_string(std::min(k, study.modes())), error_at(study, k)});
    }
    return m;
}

Measurement near_original(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m = errors_at(bench, meshes, 150);
    report::Plot plot{"claims_modes", "", "", "number of modes k", "rms error [% of the box diagonal]", true, true, {}, {}, {}};
    for (const std::string_view name : meshes) {
        const SpectralStudy& study = bench.spectrum(name);
        report::Series series{study.name(), {}, {}};
        for (int k = 1; k <= study.modes(); ++k) {
            series.x.push_back(k);
            series.y.push_back(error_at(study, k));
        }
        plot.series.push_back(std::move(series));
    }
    plot.vertical_lines = {{5, "k = 5"}, {30, "k = 30"}, {150, "k = 150"}};
    plot.caption = "Error of a mesh rebuilt from its k smoothest modes: " + readable(m.cases.front().value, 2) + " % with " +
                   std::to_string(std::min(150, bench.spectrum(meshes.front()).modes())) + " modes of " +
                   bench.spectrum(meshes.front()).name() + ".";
    plot.alt = plot.caption;
    bench.plots.push_back(plot);
    m.figure = plot.id;
    return m;
}

Measurement more_is_better(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const SpectralStudy& study = bench.spectrum("cow");
    int before = 5;
    for (const int k : {10, 30, 150}) {
        m.cases.push_back({"k = " + std::to_string(k) + " after " + std::to_string(before), error_at(study, k) / error_at(study, before)});
        before = k;
    }
    m.remark = report::text("In the area-weighted norm it cannot be otherwise: every further mode takes |ĉ|² off the squared error.");
    return m;
}

Measurement thirty_miss_the_bumps(ClaimBench& bench, const MeshNames& meshes) { return errors_at(bench, meshes, 30); }
Measurement many_are_enough(ClaimBench& bench, const MeshNames& meshes) { return errors_at(bench, meshes, 130); }

const Reconstruction* with_modes(const SpectralStudy& study, int k) {
    const auto it =
        std::find_if(study.reconstructions.begin(), study.reconstructions.end(), [&](const Reconstruction& r) { return r.k == k; });
    return it == study.reconstructions.end() ? nullptr : &*it;
}

Measurement hands_and_feet(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const SpectralStudy& study = bench.spectrum("armadillo");
    for (const int k : {5, 15, 30}) {
        const Reconstruction* r = with_modes(study, k);
        if (r && r->predicted_rms > 1e-9 * study.diagonal) m.cases.push_back({"k = " + std::to_string(k), remoteness_of_worst(study, *r)});
    }
    m.remark = report::text("What is worst at one k has most to gain at the next.");
    return m;
}

Measurement normalised_by_edges(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const MistakeStudy mistakes = mistake_study(bench.spectrum("armadillo"), !bench.settings().laboratory);
    for (const MistakeErrors& e : mistakes.errors) {
        if (e.right > 1e-9 * bench.spectrum("armadillo").diagonal)
            m.cases.push_back({"k = " + std::to_string(e.k), e.edge_normalised / e.right});
    }
    m.remark = report::text("The rms is over the vertices, which favours neither.");
    return m;
}

Measurement projection_needs_areas(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const MistakeStudy mistakes = mistake_study(bench.spectrum("armadillo"), true);
    for (const MistakeErrors& e : mistakes.errors) {
        if (e.k != 15 && e.k != 5) continue;
        m.cases.push_back({"ψ not mapped back, k = " + std::to_string(e.k), e.unmapped / e.right});
        m.cases.push_back({"the plain product xᵀφ, k = " + std::to_string(e.k), e.unweighted / e.right});
    }
    return m;
}

}   // namespace

const std::vector<Claim>& spectral_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    constexpr std::string_view error = "the area-weighted rms error of the rebuilt mesh";
    constexpr std::string_view unit = "% of the box diagonal";
    static const std::vector<Claim> claims{
        {"claims_s1_k150",
         "S1",
         "",
         "q4",
         "About 150 modes come extremely close to the original.",
         {{"bunny", "cow"}, any_mesh, {Property::above_1500_vertices}},
         {error, unit, at_most, 1},
         Effort::full,
         near_original},
        {"claims_s1_more_modes",
         "S1",
         "",
         "q4",
         "Every larger k gives a more detailed result.",
         {{"cow"}, any_mesh, {Property::above_1500_vertices}},
         {"the error over that of the next smaller k tried", "", at_most, 0.95},
         Effort::full,
         more_is_better},
        {"claims_s2_k30",
         "S2",
         "",
         "q4",
         "5 to 30 modes of the bumpy cube are not enough for its bumps.",
         {{"bumpy_cube"}, itself},
         {error, unit, at_least, 0.5},
         Effort::full,
         thirty_miss_the_bumps},
        {"claims_s2_k130",
         "S2",
         "",
         "q4",
         "With more than a hundred modes the bumpy cube is almost the original.",
         {{"bumpy_cube"}, itself},
         {error, unit, at_most, 1},
         Effort::full,
         many_are_enough},
        {"claims_s3_hands_feet",
         "S3",
         "",
         "q4",
         "Hands, feet and tail change most as k grows.",
         {{"armadillo"}, its_kind},
         {"the distance from the centroid of the worst-placed twentieth of the vertices, over that of the average", "", at_least, 1.2},
         Effort::full,
         hands_and_feet},
        {"claims_s3_edge_areas",
         "S3",
         "",
         "q4",
         "Dividing each weight by A_i + A_j improves the reconstruction.",
         {{"armadillo"}},
         {"the rms error with that operator over that of the M-orthonormal projection", "", at_most, 0.99},
         Effort::full,
         normalised_by_edges},
        {"claims_vallet_projection",
         "Vallet & Lévy 2008",
         "vallet_levy_2008",
         "q4",
         "Modes have to be mapped back by M⁻½ and coefficients taken in the inner product of M.",
         {{"armadillo"}, any_mesh, {Property::unequal_areas}},
         {"the rms error without either step over that with both", "", at_least, 1},
         Effort::full,
         projection_needs_areas},
    };
    return claims;
}

}   // namespace meshfolio::claims
