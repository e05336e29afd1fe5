// Claims of the papers that the methods come from.
#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

Measurement deficits_sum_up(ClaimBench& bench, const MeshNames& meshes) {
    const auto error = [&](std::string_view name) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        const Preflight& p = source.preflight();
        const Vector deficits = angle_deficit(source.mesh(), source.topology());
        return Case{source.name + ", χ = " + std::to_string(p.euler_characteristic),
                    p.manifold() ? gauss_bonnet_error(deficits, p.euler_characteristic) : std::nan("")};
    };
    return {.cases = each_of(meshes, error), .remark = words.say("claims_meyer_gauss_bonnet.remark")};
}

/// Order of the error of the cotangent H with these areas, between a coarse and a fine mesh.
double order_on(ClaimBench& bench, const std::string& surface, MeshKind kind, const std::string& areas) {
    const int level = bench.settings().laboratory ? 5 : 4;
    return bench.curvature(surface, kind, level - 1, level).errors("H." + areas).order().exponent;
}

Measurement mixed_areas_converge(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    for (const MeshKind kind : {MeshKind::regular, MeshKind::random})
        for (const char* surface : {"sphere", "ellipsoid", "torus"})
            m.cases.push_back({sampled(kind, surface), order_on(bench, surface, kind, "mixed")});
    return m;
}

Measurement no_pointwise_convergence(ClaimBench& bench, const MeshNames&) {
    return {.cases = each_of(std::array{"barycentric", "mixed"}, [&](const char* areas) {
                return Case{
                    words.line("claims_wardetzky_pointwise.case", "areas"_a = areas, "sampling"_a = sampled(MeshKind::random, "sphere")),
                    order_on(bench, "sphere", MeshKind::random, areas)};
            })};
}

Measurement implicit_step_beats_ten(ClaimBench& bench, const MeshNames&) {
    const SmoothingSubject& s = bench.subject("fandisk_ns");
    const RunKey one{implicit_euler, 10, 1, OperatorKind::uniform}, ten{explicit_euler, 1, 10, OperatorKind::uniform};
    const auto left = [&](const RunKey& key) { return roughness(s, bench.run("fandisk_ns", key).X); };
    return {.cases = {{"roughness left", left(one) / left(ten)},
                      {words.line("claims_desbrun_one_step.case"),
                       implicit_operations(bench.run("fandisk_ns", one), 1) / explicit_operations(s, 10)}},
            .remark = words.say("claims_desbrun_one_step.remark")};
}

/// λ and μ of Taubin's example, for the uniform operator: pass-band 1/λ + 1/μ = 0.1.
constexpr double taubin_lambda = 0.6307, taubin_mu = -0.6732;

Measurement taubin_keeps_volume(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    double shrunk = 0;
    for (const std::string_view name : meshes) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        const SmoothingOptions options{
            .scheme = taubin, .laplacian = OperatorKind::uniform, .lambda = taubin_lambda, .taubin_mu = taubin_mu, .iterations = 50};
        const double before = signed_volume(source.mesh());
        const auto lost = [&](const Positions& X) { return 1 - signed_volume(moved_to(source.mesh(), X)) / before; };
        m.cases.push_back({source.name + ", 50 double steps", 100 * lost(smooth(source.mesh(), options).X)});
        shrunk = std::max(shrunk, lost(bench.run(name, {explicit_euler, taubin_lambda, 50, OperatorKind::uniform}).X));
    }
    m.remark = words.say("claims_taubin_volume.remark", "shrunk"_a = readable_percent(shrunk, 2));
    return m;
}

/// λ_crit with the stiffness of the intrinsic Delaunay triangulation and the areas of the mesh, over that of the mesh.
Measurement delaunay_limit(ClaimBench& bench, const MeshNames& meshes) {
    const auto gained = [&](std::string_view name) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        const LaplaceBeltrami delaunay = laplace_operator(source.mesh(), OperatorKind::idt_original_mass);
        return Case{source.name, largest_stable_step(largest_eigenvalue(delaunay)) / bench.subject(name).critical};
    };
    return {.cases = each_of(meshes, gained), .remark = words.say("claims_rippa_delaunay.remark")};
}

}   // namespace

extern const std::vector<Claim> paper_claims{
    {"claims_meyer_gauss_bonnet", "q1", {{"armadillo", "plane", "lilium", "torus"}}, {"gauss_bonnet", "", at_most, 1e-9}, deficits_sum_up},
    {"claims_meyer_mixed", "q3", {}, {"order", "", at_least, 1.5}, mixed_areas_converge, full},
    {"claims_wardetzky_pointwise", "q3", {}, {"order", "", at_most, 0.5}, no_pointwise_convergence, full},
    {"claims_rippa_delaunay", "q5", {{"bunny", "lilium", "plane_ns"}}, {"delaunay_limit", "", at_least, 1 - 1e-9}, delaunay_limit, full},
    {"claims_taubin_volume", "q5", {{"bunny", "bumpy_cube"}, {closed}}, {"volume_lost", "%", at_most, 1}, taubin_keeps_volume, full},
    {"claims_desbrun_one_step", "q6", {{"fandisk_ns"}}, {"implicit_over_explicit", "", at_most, 1}, implicit_step_beats_ten, full}};

}   // namespace meshfolio::claims
