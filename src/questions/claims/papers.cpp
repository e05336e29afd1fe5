// Claims of the papers that the methods come from.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "mesh/triangle_measures.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"

namespace meshfolio::claims {

namespace {

using enum SmoothingScheme;

Measurement deficits_sum_up(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    for (const std::string_view name : meshes) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        const Preflight& p = source.prepared->preflight;
        const Vector deficits = angle_deficit(source.mesh(), source.prepared->topology);
        m.cases.push_back({source.name + ", χ = " + std::to_string(p.euler_characteristic),
                           p.manifold() ? gauss_bonnet_error(deficits, p.euler_characteristic) : std::nan("")});
    }
    m.remark = report::text(
        "On the boundary π takes the place of 2π. It says that the deficits are right together, not that each is a good K: "
        "that depends on the area it is divided by ",
        report::ref("borrelli_2003"), ".");
    return m;
}

/// Error of the cotangent H with mixed areas on random and regular triangles, coarse and fine: the order between them.
Measurement mixed_areas_converge(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const int level = bench.settings().laboratory ? 5 : 4;
    for (const MeshKind kind : {MeshKind::regular, MeshKind::random}) {
        for (const char* surface : {"sphere", "ellipsoid", "torus"}) {
            const PanelLevel &coarse = bench.panel(surface, kind, level - 1), &fine = bench.panel(surface, kind, level);
            const std::size_t mixed = estimator_index(Quantity::H, "mixed");
            const FittedOrder order = order_with_error({coarse.mean_edge, fine.mean_edge}, {coarse.H[mixed].l2, fine.H[mixed].l2});
            m.cases.push_back({std::string(name_of(kind)) + " triangles on the " + surface, order.order});
        }
    }
    return m;
}

Measurement implicit_step_beats_ten(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const SmoothingSubject& s = bench.subject("fandisk_ns");
    const RunKey one{implicit_euler, 10, 1, OperatorKind::uniform}, ten{explicit_euler, 1, 10, OperatorKind::uniform};
    const auto left = [&](const RunKey& key) { return roughness(s, bench.run("fandisk_ns", key).X); };
    m.cases = {{"roughness left", left(one) / left(ten)}};
    const auto entries = static_cast<double>(bench.run("fandisk_ns", one).factor_nonzeros);
    m.cases.push_back({"multiplications, the factorisation by its lower bound",
                       (6 * entries + entries * entries / double(s.mesh().vertex_count())) / (30.0 * double(s.laplacian.C.nonZeros()))});
    m.remark = report::text(
        "The paper solves by conjugate gradients, which need fewer operations than the factorisation counted here when there "
        "is but one step to make.");
    return m;
}

/// λ and μ of Taubin's example, for the uniform operator: pass-band 1/λ + 1/μ = 0.1.
constexpr double taubin_lambda = 0.6307, taubin_mu = -0.6732;

Measurement taubin_keeps_volume(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    double shrunk = 0;
    for (const std::string_view name : meshes) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        SmoothingOptions options;
        options.scheme = taubin;
        options.laplacian = OperatorKind::uniform;
        options.lambda = taubin_lambda;
        options.taubin_mu = taubin_mu;
        options.iterations = 50;
        const double before = signed_volume(source.mesh());
        const TriangleMesh smoothed = moved_to(source.mesh(), smooth(source.mesh(), options).X);
        m.cases.push_back({source.name + ", 50 double steps", 100 * (1 - signed_volume(smoothed) / before)});
        const RunKey laplacian{explicit_euler, taubin_lambda, 50, OperatorKind::uniform};
        shrunk = std::max(shrunk, 1 - signed_volume(moved_to(source.mesh(), bench.run(name, laplacian).X)) / before);
    }
    m.remark = report::text("The positive steps alone shrink it by up to ", readable_percent(shrunk, 2), ". A negative loss is a gain.");
    return m;
}

/// λ_crit with the stiffness of the intrinsic Delaunay triangulation and the areas of the mesh, over that of the mesh.
Measurement delaunay_is_never_rougher(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    for (const std::string_view name : meshes) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        const LaplaceBeltrami delaunay = laplace_operator(source.mesh(), OperatorKind::idt_original_mass);
        m.cases.push_back({source.name, largest_stable_step(largest_eigenvalue(delaunay)) / bench.subject(name).critical});
    }
    m.remark = report::text(
        "Of all triangulations of the same points the Delaunay one gives every function the least Dirichlet energy, so that "
        "no eigenvalue can rise.");
    return m;
}

Measurement no_pointwise_convergence(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const int level = bench.settings().laboratory ? 5 : 4;
    for (const char* key : {"barycentric", "mixed"}) {
        const PanelLevel &coarse = bench.panel("sphere", MeshKind::random, level - 1),
                         &fine = bench.panel("sphere", MeshKind::random, level);
        const std::size_t estimator = estimator_index(Quantity::H, key);
        const FittedOrder order = order_with_error({coarse.mean_edge, fine.mean_edge}, {coarse.H[estimator].l2, fine.H[estimator].l2});
        m.cases.push_back({std::string(key) + " areas, random triangles on the sphere", order.order});
    }
    return m;
}

}   // namespace

const std::vector<Claim>& paper_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    constexpr std::string_view order = "the order of the L2 error of cotangent H between two refinements";
    static const std::vector<Claim> claims{
        {"claims_meyer_gauss_bonnet",
         "Meyer et al. 2003",
         "meyer_2003",
         "q1",
         "Angle deficits satisfy the theorem of Gauss and Bonnet exactly.",
         {{"armadillo", "plane", "lilium", "torus"}},
         {"|Σ deficits/2π − χ|", "", at_most, 1e-9},
         Effort::quick,
         deficits_sum_up},
        {"claims_meyer_mixed",
         "Meyer et al. 2003",
         "meyer_2003",
         "q3",
         "With mixed areas the mean curvature converges under refinement.",
         {},
         {order, "", at_least, 1.5},
         Effort::full,
         mixed_areas_converge},
        {"claims_wardetzky_pointwise",
         "Wardetzky 2008",
         "wardetzky_2008",
         "q3",
         "On general triangulations cotangent mean curvature does not converge pointwise.",
         {},
         {order, "", at_most, 0.5},
         Effort::full,
         no_pointwise_convergence},
        {"claims_rippa_delaunay",
         "Rippa 1990",
         "rippa_1990",
         "q5",
         "The Delaunay triangulation has the least Dirichlet energy: with its stiffness and the same areas the limit cannot fall.",
         {{"bunny", "lilium", "plane_ns"}},
         {"λ_crit with the intrinsic Delaunay stiffness over that of the mesh, to nine digits", "", at_least, 1 - 1e-9},
         Effort::full,
         delaunay_is_never_rougher},
        {"claims_taubin_volume",
         "Taubin 1995",
         "taubin_1995",
         "q5",
         "Alternating a positive and a negative step smooths without shrinking.",
         {{"bunny", "bumpy_cube"}, any_mesh, {Property::closed}},
         {"the volume lost", "%", at_most, 1},
         Effort::full,
         taubin_keeps_volume},
        {"claims_desbrun_one_step",
         "Desbrun et al. 1999",
         "desbrun_1999",
         "q6",
         "One implicit step of λ = 10 smooths better than ten explicit ones of 1, and faster.",
         {{"fandisk_ns"}},
         {"implicit over explicit", "", at_most, 1},
         Effort::full,
         implicit_step_beats_ten},
    };
    return claims;
}

}   // namespace meshfolio::claims
