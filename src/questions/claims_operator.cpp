// Claims about the operator itself: its symmetry, and what changing its weights does to the largest stable step.
#include "geometry/mesh_laws.h"
#include "number_text.h"
#include "questions/claim_bench.h"
#include "questions/claim_list.h"

namespace meshfolio {

namespace {

SparseMatrix L_of(const LaplaceBeltrami& laplacian) {
    Vector inverse = laplacian.M;
    for (double& a : inverse) a = a > 0 ? 1 / a : 0;
    return inverse.asDiagonal() * laplacian.C;
}

Measurement C_not_symmetric(ClaimBench& bench) {
    Measurement m;
    const LaplaceBeltrami& laplacian = bench.subject("bunny").laplacian;
    m.cases = {{"C", asymmetry(laplacian.C)}};
    m.meshes = bench.called({"bunny"});
    m.remark = report::text("It is M⁻¹C that is not symmetric: ", readable(asymmetry(L_of(laplacian)), 2), ".");
    return m;
}

Measurement L_not_symmetric(ClaimBench& bench) {
    Measurement m;
    m.cases = {{"L = M⁻¹C", asymmetry(L_of(bench.subject("bunny").laplacian))}};
    m.meshes = bench.called({"bunny"});
    return m;
}

Measurement clamping_is_stable(ClaimBench& bench) {
    Measurement m;
    for (const std::string_view name : {"armadillo", "lilium", "plane_ns"}) {
        const TriangleMesh& mesh = bench.mesh(name).mesh->mesh();
        const double clamped = largest_stable_step(largest_eigenvalue(laplace_operator(mesh, OperatorKind::clamped)));
        m.cases.push_back({bench.mesh(name).mesh->name, clamped / bench.subject(name).critical});
        if (bench.mesh("lilium").mesh == bench.mesh("armadillo").mesh) break;   // the user's own mesh in every place
    }
    m.meshes = bench.called({"armadillo", "lilium", "plane_ns"});
    m.remark = report::text("Weights set to zero make no entry of the diagonal smaller.");
    return m;
}

}   // namespace

const std::vector<Claim>& operator_claims() {
    using enum Rule::Relation;
    static const std::vector<Claim> claims{
        {"claims_s1_symmetric",
         "S1",
         "",
         "q4",
         "The cotangent matrix C is not symmetric.",
         {"the largest |C_ij − C_ji| over the largest |C_ij|", "", at_least, 1e-9},
         Effort::quick,
         C_not_symmetric},
        {"claims_s2_symmetric",
         "S2",
         "",
         "q4",
         "The Laplacian M⁻¹C is not symmetric.",
         {"the largest |L_ij − L_ji| over the largest |L_ij|", "", at_least, 1e-3},
         Effort::quick,
         L_not_symmetric},
        {"claims_s3_clamp_stable",
         "S3",
         "",
         "q4",
         "Filtering out negative weights makes the operator more stable.",
         {"λ_crit with clamped weights over λ_crit with all", "", at_least, 1.01},
         Effort::full,
         clamping_is_stable},
    };
    return claims;
}

}   // namespace meshfolio
