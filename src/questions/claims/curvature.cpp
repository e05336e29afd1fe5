// Claims about estimates of curvature, held against surfaces whose curvature is known, and about the ellipsoid.
#include "geometry/curvature/fundamental_forms.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "questions/bench/ellipsoid_study.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

int level_of(const ClaimBench& bench) { return bench.settings().laboratory ? 5 : bench.settings().quick ? 3 : 4; }

/// The runs of both surfaces in both kinds of triangles.
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

/// The largest distance of the heights from [0, 1] after one implicit step, from a height of 1 at a single vertex; 0 if no weight is
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
    const auto miss = [&](double v) { return (ellipsoid_point(flat_ellipsoid, 0, v) - tip).norm() / flat_ellipsoid.a; };
    return {.cases = {{"(u, v) = (0, π)", miss(pi)}}, .remarked = true};
}

Measurement places_of_extrema(ClaimBench&, const MeshNames&) {
    const auto ratio = [](const Ellipsoid& e) {
        return Case{(e.b < e.c ? "b < c, " : "b > c, ") + axes_text(e), tip_curvature_by_angle(e, 0) / tip_curvature_by_angle(e, pi / 2)};
    };
    return {.cases = each_of(std::array{tall_ellipsoid, flat_ellipsoid}, ratio), .remarked = true};
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
    {"claims_s3_plane_rapid", "q3", {{"plane"}, {}, itself}, {"jumps", "", at_most, 1}, less_rapid_on_plane}};

}   // namespace meshfolio::claims
