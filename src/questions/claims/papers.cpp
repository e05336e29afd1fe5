// Claims of the papers that the methods come from.
#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

Case angle_sum(ClaimBench& bench, std::string_view name) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const Preflight& p = source.preflight();
    const Vector deficits = angle_deficit(source.mesh(), source.topology());
    return {source.name + ", χ = " + std::to_string(p.euler_characteristic),
            p.manifold() ? gauss_bonnet_error(deficits, p.euler_characteristic) : std::nan("")};
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
    Measurement m;
    for (const char* areas : {"barycentric", "mixed"})
        m.cases.push_back(
            {words.line("claims_wardetzky_pointwise.case", "areas"_a = areas, "sampling"_a = sampled(MeshKind::random, "sphere")),
             order_on(bench, "sphere", MeshKind::random, areas)});
    return m;
}

Measurement implicit_step_beats_ten(ClaimBench& bench, const MeshNames&) {
    const SmoothingSubject& s = bench.subject("fandisk_ns");
    const RunKey one{implicit_euler, 10, 1, OperatorKind::uniform}, ten{explicit_euler, 1, 10, OperatorKind::uniform};
    const auto left = [&](const RunKey& key) { return roughness(s, bench.run("fandisk_ns", key).X); };
    const double operations = implicit_operations(bench.run("fandisk_ns", one), 1) / explicit_operations(s, 10);
    return {.cases = {{"roughness left", left(one) / left(ten)}, {words.line("claims_desbrun_one_step.case"), operations}},
            .remarked = true};
}

Measurement taubin_keeps_volume(ClaimBench& bench, const MeshNames& meshes) {
    constexpr double lambda = 0.6307, mu = -0.6732;   // Taubin's example for the uniform operator: pass-band 1/λ + 1/μ = 0.1
    Measurement m;
    double shrunk = 0;
    for (const std::string_view name : meshes) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        const SmoothingOptions options{
            .scheme = taubin, .laplacian = OperatorKind::uniform, .lambda = lambda, .taubin_mu = mu, .iterations = 50};
        const double before = signed_volume(source.mesh());
        const auto lost = [&](const Positions& X) { return 1 - signed_volume(moved_to(source.mesh(), X)) / before; };
        m.cases.push_back({source.name + ", 50 double steps", 100 * lost(smooth(source.mesh(), options).X)});
        shrunk = std::max(shrunk, lost(bench.run(name, {explicit_euler, lambda, 50, OperatorKind::uniform}).X));
    }
    m.remark = words.say("claims_taubin_volume.remark", "shrunk"_a = readable_percent(shrunk, 2));
    return m;
}

/// λ_crit with the stiffness of the intrinsic Delaunay triangulation and the areas of the mesh, over that of the mesh.
Case delaunay(ClaimBench& bench, std::string_view name) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const LaplaceBeltrami delaunay = laplace_operator(source.mesh(), OperatorKind::idt_original_mass);
    return {source.name, largest_stable_step(largest_eigenvalue(delaunay)) / bench.subject(name).critical};
}

}   // namespace

extern const std::vector<Claim> paper_claims{
    {"claims_meyer_gauss_bonnet",
     "q1",
     {{"armadillo", "plane", "lilium", "torus"}},
     {"gauss_bonnet", "", at_most, 1e-9},
     remarked(angle_sum)},
    {"claims_meyer_mixed", "q3", {}, {"order", "", at_least, 1.5}, mixed_areas_converge, full},
    {"claims_wardetzky_pointwise", "q3", {}, {"order", "", at_most, 0.5}, no_pointwise_convergence, full},
    {"claims_rippa_delaunay",
     "q5",
     {{"bunny", "lilium", "plane_ns"}},
     {"delaunay_limit", "", at_least, 1 - 1e-9},
     remarked(delaunay),
     full},
    {"claims_taubin_volume", "q5", {{"bunny", "bumpy_cube"}, {closed}}, {"volume_lost", "%", at_most, 1}, taubin_keeps_volume, full},
    {"claims_desbrun_one_step", "q6", {{"fandisk_ns"}}, {"implicit_over_explicit", "", at_most, 1}, implicit_step_beats_ten, full}};

}   // namespace meshfolio::claims
