// Claims about the operator itself: its symmetry, and what changing its weights does to the largest stable step.
#include "geometry/measures/mesh_laws.h"
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

Measurement clamping_is_stable(ClaimBench& bench, const MeshNames& meshes) {
    const auto gained = [&](std::string_view name) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        const double clamped = largest_stable_step(largest_eigenvalue(laplace_operator(source.mesh(), OperatorKind::clamped)));
        return Case{source.name, clamped / bench.subject(name).critical};
    };
    return {.cases = each(meshes, gained), .remark = words.say("claims_s3_clamp_stable.remark")};
}

}   // namespace

extern const std::vector<Claim> operator_claims{
    {"claims_s1_symmetric", "q4", {{"bunny"}}, {"asymmetry_c", "", at_least, 1e-9}, C_not_symmetric},
    {"claims_s2_symmetric", "q4", {{"bunny"}, {unequal_areas}}, {"asymmetry_l", "", at_least, 1e-3}, L_not_symmetric},
    {"claims_s3_clamp_stable",
     "q4",
     {{"armadillo", "lilium", "plane_ns"}, {negative_weights}},
     {"clamped_limit", "", at_least, 1.01},
     clamping_is_stable,
     full}};

}   // namespace meshfolio::claims
