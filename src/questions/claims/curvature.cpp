// Claims about estimates of curvature, tested on surfaces of known curvature, and about the ellipsoid.
#include "geometry/curvature/curvature.h"
#include "geometry/curvature/fundamental_forms.h"
#include "geometry/measures/mesh_laws.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "questions/bench/ellipsoid_study.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

int level_of(const ClaimBench& bench) { return bench.settings().laboratory ? 5 : bench.settings().quick ? 3 : 4; }

/// The ellipsoid and the torus, in regular and in random triangles.
BenchRuns runs_of(ClaimBench& bench) {
    BenchRuns runs;
    for (const MeshKind kind : {MeshKind::regular, MeshKind::random})
        for (const char* surface : {"ellipsoid", "torus"}) runs.push_back(bench.curvature(surface, kind, level_of(bench), level_of(bench)));
    return runs;
}

constexpr std::string_view by_uniform = "H.uniform", by_cotangent = "H.barycentric", by_deficit = "K.barycentric";

/// The error of one estimator, over the least error of the others.
Measure error_ratio(std::string_view estimator, std::vector<std::string_view> others) {
    return [=](ClaimBench& bench, const MeshNames&) {
        Measurement m;
        for (const BenchRun& run : runs_of(bench)) {
            const auto error = [&](std::string_view key) { return run.finest().error(key).l2; };
            m.cases.push_back({sampled(run.kind, run.surface), error(estimator) / std::ranges::min(each_of(others, error))});
        }
        return m;
    };
}

Measurement uniform_inaccurate(ClaimBench& bench, const MeshNames&) {
    Measurement m{.remarked = true};
    for (const BenchRun& run : runs_of(bench)) m.cases.push_back({sampled(run.kind, run.surface), 100 * run.finest().error(by_uniform).l2});
    return m;
}

Measurement not_influenced(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const int level = level_of(bench);
    for (const char* surface : {"sphere", "ellipsoid"})
        for (const BenchLevel& at : bench.curvature(surface, MeshKind::random, level - 1, level).levels)
            m.cases.push_back(
                {words.line("claims_s0_irregular.case", "sampling"_a = sampled(MeshKind::random, surface), "vertices"_a = at.vertices),
                 100 * at.error(by_cotangent).l2});
    const double regular = bench.curvature("ellipsoid", MeshKind::regular, level, level).finest().error(by_cotangent).l2;
    m.remark = words.say("claims_s0_irregular.remark", "error"_a = readable(100 * regular));
    if (m.cases[3].value > 0.7 * m.cases[2].value) go_on(m.remark, words.say("claims_s0_irregular.remark.stays"));
    return m;
}

Measurement uniform_on_flat(ClaimBench& bench, const MeshNames&) {
    return {.cases = {{words.line("case.flat_square"), bench.plane().uniform}}, .remarked = true};
}

Measurement cotangent_on_flat(ClaimBench& bench, const MeshNames&) {
    return {.cases = {{words.line("case.flat_square"), bench.plane().cotangent}},
            .remark = words.say("claims_s2_artefacts.remark", "uniform"_a = readable(bench.plane().uniform, 2))};
}

/// Raises one vertex to the height 1, makes one implicit step, and returns the largest distance of a height from [0, 1]; 0 if no weight is
/// negative. The vertex is an end of the edge with the most negative weight, the step a tenth of the squared mean edge.
double overshoot(const TriangleMesh& mesh, OperatorKind kind) {
    const SparseMatrix weights = laplace_beltrami(mesh).C;
    Eigen::Index raised = 0;
    double least = 0;
    for (int column = 0; column < weights.outerSize(); ++column)
        for (SparseMatrix::InnerIterator entry(weights, column); entry; ++entry)
            if (entry.row() != entry.col() && entry.value() < least) least = entry.value(), raised = entry.row();
    Positions heights = Positions::Zero(mesh.vertex_count(), 3);
    heights(raised, 2) = 1;
    const double edge = mean_edge_length(mesh);
    const Vector after = implicit_step(laplace_operator(mesh, kind), 0.1 * edge * edge, heights).col(2);
    return std::max({0.0, -after.minCoeff(), after.maxCoeff() - 1});
}

Measurement clamping_is_harmless(ClaimBench& bench, const MeshNames&) {
    const PlaneTest& plane = bench.plane();
    return {.cases = {{words.line("claims_s3_clamp.case"), overshoot(plane.mesh, OperatorKind::clamped)}},
            .remark = words.say("claims_s3_clamp.remark", "negative"_a = readable_percent(plane.negative_weights, 2),
                                "kept"_a = readable_percent(overshoot(plane.mesh, OperatorKind::cotan), 2),
                                "curvature"_a = readable(plane.clamped, 2))};
}

Case angle_sum(ClaimBench& bench, std::string_view name) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const Preflight& p = source.preflight();
    const Vector deficits = angle_deficit(source.mesh(), source.topology());
    return {source.name + ", χ = " + std::to_string(p.euler_characteristic),
            p.manifold() ? gauss_bonnet_error(deficits, p.euler_characteristic) : std::nan("")};
}
const Measure gauss_bonnet = remarked(angle_sum);

/// Order of convergence of the cotangent H with these areas, between a coarse and a fine mesh.
double order_on(ClaimBench& bench, const std::string& surface, MeshKind kind, const std::string& areas) {
    const int level = level_of(bench);
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

// ---- the plane of the assignment --------------------------------------------------------------------------------------------

Measurement structure_on_plane(ClaimBench& bench, const MeshNames&) {
    const CotangentComparison c = compare_operators(bench.mesh("plane").mesh);
    Measurement m{.cases = {{"cotangent H inside", c.precision}, {"uniform H inside", c.drift}}};
    if (std::max(c.precision, c.drift) < 0.01)
        m.remark = words.say("claims_s3_plane_structure.remark", "boundary"_a = readable(c.variants.front().boundary));
    return m;
}

Measurement less_rapid_on_plane(ClaimBench& bench, const MeshNames&) {
    const CotangentComparison c = compare_operators(bench.mesh("plane").mesh);
    if (c.drift < 1e-9 && c.precision < 1e-9) return {.undecidable = words.line("claims_s3_plane_rapid.undecidable")};
    return {.cases = {{"inside", c.jump_cotangent / c.jump_uniform}}};
}

Measurement uniform_on_plane(ClaimBench& bench, const MeshNames&) {
    const double drift = compare_operators(bench.mesh("plane").mesh).drift;
    return {.cases = {{"inside", drift}}, .remark = drift < 0.001 ? words.say("claims_s3_plane_uniform.remark") : report::Text()};
}

// ---- the ellipsoid ----------------------------------------------------------------------------------------------------------

Measurement parameters_of_the_tip(ClaimBench&, const MeshNames&) {
    const Vector3 tip(flat_ellipsoid.a, 0, 0);
    const double miss = (ellipsoid_point(flat_ellipsoid, 0, pi) - tip).norm() / flat_ellipsoid.a;
    return {.cases = {{"(u, v) = (0, π)", miss}}, .remarked = true};
}

Measurement places_of_extrema(ClaimBench&, const MeshNames&) {
    Measurement m{.remarked = true};
    for (const Ellipsoid& e : {tall_ellipsoid, flat_ellipsoid})
        m.cases.push_back(
            {(e.b < e.c ? "b < c, " : "b > c, ") + axes_text(e), tip_curvature_by_angle(e, 0) / tip_curvature_by_angle(e, pi / 2)});
    return m;
}

}   // namespace

extern const std::vector<Claim> curvature_claims{
    {"claims_s0_uniform", "q1", {}, {"uniform_error", "%", at_least, 10}, uniform_inaccurate},
    {"claims_s0_drift", "q1", {}, {"flat_h", "", at_least, 0.01}, uniform_on_flat},
    {"claims_s1_deficit", "q1", {}, {"error_ratio", "", at_most, 1}, error_ratio(by_deficit, {by_uniform})},
    {"claims_s3_plane_uniform", "q1", {{"plane"}, {flat}, its_kind}, {"flat_h", "", at_most, 0.001}, uniform_on_plane},
    {"claims_s3_plane_structure", "q1", {{"plane"}, {flat}, itself}, {"flat_h", "", at_least, 0.01}, structure_on_plane},
    {"claims_s3_tip", "q2", {}, {"tip_distance", "", at_most, 1e-9}, parameters_of_the_tip},
    {"claims_s3_extrema", "q2", {}, {"normal_curvatures", "", at_least, 1}, places_of_extrema},
    {"claims_s0_irregular", "q3", {}, {"random_error", "%", at_most, 5}, not_influenced},
    {"claims_s0_best", "q3", {}, {"error_over_others", "", at_most, 1}, error_ratio(by_cotangent, {by_uniform, by_deficit})},
    {"claims_s1_cotangent", "q3", {}, {"error_ratio", "", at_most, 0.5}, error_ratio(by_cotangent, {by_uniform})},
    {"claims_s1_over_deficit", "q3", {}, {"error_ratio", "", at_most, 1}, remarked(error_ratio(by_cotangent, {by_deficit}))},
    {"claims_s2_artefacts", "q3", {}, {"flat_h", "", at_most, 1e-9}, cotangent_on_flat},
    {"claims_s3_clamp", "q3", {}, {"overshoot", "", at_most, 1e-12}, clamping_is_harmless},
    {"claims_s3_plane_rapid", "q3", {{"plane"}, {}, itself}, {"jumps", "", at_most, 1}, less_rapid_on_plane},
    {"claims_meyer_gauss_bonnet", "q1", {{"armadillo", "plane", "lilium", "torus"}}, {"gauss_bonnet", "", at_most, 1e-9}, gauss_bonnet},
    {"claims_meyer_mixed", "q3", {}, {"order", "", at_least, 1.5}, mixed_areas_converge, full},
    {"claims_wardetzky_pointwise", "q3", {}, {"order", "", at_most, 0.5}, no_pointwise_convergence, full}};

}   // namespace meshfolio::claims
