// Claims about the operator itself: its symmetry, and what changing its weights does to the largest stable step.
#include "base/number_text.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"

namespace meshfolio::claims {

namespace {

SparseMatrix L_of(const LaplaceBeltrami& laplacian) {
    Vector inverse = laplacian.M;
    for (double& a : inverse) a = a > 0 ? 1 / a : 0;
    return inverse.asDiagonal() * laplacian.C;
}

Measurement C_not_symmetric(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const LaplaceBeltrami& laplacian = bench.subject("bunny").laplacian;
    m.cases = {{"C", asymmetry(laplacian.C)}};
    const double of_L = asymmetry(L_of(laplacian));
    if (of_L > 1e-9) m.remark = report::text("It is M⁻¹C that is not symmetric: ", readable(of_L, 2), ".");
    return m;
}

Measurement L_not_symmetric(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    m.cases = {{"L = M⁻¹C", asymmetry(L_of(bench.subject("bunny").laplacian))}};
    return m;
}

Measurement clamping_is_stable(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    for (const std::string_view name : meshes) {
        const TriangleMesh& mesh = bench.mesh(name).mesh->mesh();
        const double clamped = largest_stable_step(largest_eigenvalue(laplace_operator(mesh, OperatorKind::clamped)));
        m.cases.push_back({bench.mesh(name).mesh->name, clamped / bench.subject(name).critical});
    }
    m.remark = report::text("Weights set to zero make no entry of the diagonal smaller.");
    return m;
}

}   // namespace

const std::vector<Claim>& operator_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    static const std::vector<Claim> claims{
        {"claims_s1_symmetric",
         "S1",
         "",
         "q4",
         "The cotangent matrix C is not symmetric.",
         {{"bunny"}},
         {"the largest |C_ij − C_ji| over the largest |C_ij|", "", at_least, 1e-9},
         Effort::quick,
         C_not_symmetric},
        {"claims_s2_symmetric",
         "S2",
         "",
         "q4",
         "The Laplacian M⁻¹C is not symmetric.",
         {{"bunny"}, any_mesh, {Property::unequal_areas}},
         {"the largest |L_ij − L_ji| over the largest |L_ij|", "", at_least, 1e-3},
         Effort::quick,
         L_not_symmetric},
        {"claims_s3_clamp_stable",
         "S3",
         "",
         "q4",
         "Filtering out negative weights makes the operator more stable.",
         {{"armadillo", "lilium", "plane_ns"}, any_mesh, {Property::negative_weights}},
         {"λ_crit with clamped weights over λ_crit with all", "", at_least, 1.01},
         Effort::full,
         clamping_is_stable},
    };
    return claims;
}

}   // namespace meshfolio::claims
