// Claims about estimates of curvature, held against surfaces whose curvature is known, and about the ellipsoid.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/curvature/fundamental_forms.h"
#include "questions/bench/ellipsoid_study.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"
#include "questions/core/section_tools.h"

namespace meshfolio::claims {

namespace {

/// A surface in one kind of triangles.
struct Sampling {
    std::string surface;
    MeshKind kind;
    std::string words() const { return std::string(name_of(kind)) + " triangles on the " + surface; }
};
const std::vector<Sampling>& samplings() {
    static const std::vector<Sampling> all{
        {"ellipsoid", MeshKind::regular}, {"torus", MeshKind::regular}, {"ellipsoid", MeshKind::random}, {"torus", MeshKind::random}};
    return all;
}

int level_of(const ClaimBench& bench) { return bench.settings().laboratory ? 5 : bench.settings().quick ? 3 : 4; }

double error_of(ClaimBench& bench, const Sampling& s, Quantity quantity, const std::string& key, int coarser = 0) {
    const PanelLevel& level = bench.panel(s.surface, s.kind, level_of(bench) - coarser);
    return (quantity == Quantity::H ? level.H : level.K)[estimator_index(quantity, key)].l2;
}
double uniform_error(ClaimBench& bench, const Sampling& s) { return error_of(bench, s, Quantity::H, "uniform"); }
double cotangent_error(ClaimBench& bench, const Sampling& s) { return error_of(bench, s, Quantity::H, "barycentric"); }
double deficit_error(ClaimBench& bench, const Sampling& s) { return error_of(bench, s, Quantity::K, "barycentric"); }

Measurement over_samplings(ClaimBench& bench, double (*value)(ClaimBench&, const Sampling&)) {
    Measurement m;
    for (const Sampling& s : samplings()) m.cases.push_back({s.words(), value(bench, s)});
    return m;
}

Measurement uniform_inaccurate(ClaimBench& bench, const MeshNames&) {
    Measurement m = over_samplings(bench, [](ClaimBench& b, const Sampling& s) { return 100 * uniform_error(b, s); });
    m.remark = report::text("Already multiplied by 4/h², without which it is not even a curvature but a length.");
    return m;
}

Measurement deficit_beats_uniform(ClaimBench& bench, const MeshNames&) {
    return over_samplings(bench, [](ClaimBench& b, const Sampling& s) { return deficit_error(b, s) / uniform_error(b, s); });
}

Measurement cotangent_beats_uniform(ClaimBench& bench, const MeshNames&) {
    return over_samplings(bench, [](ClaimBench& b, const Sampling& s) { return cotangent_error(b, s) / uniform_error(b, s); });
}

Measurement cotangent_beats_both(ClaimBench& bench, const MeshNames&) {
    return over_samplings(
        bench, [](ClaimBench& b, const Sampling& s) { return cotangent_error(b, s) / std::min(uniform_error(b, s), deficit_error(b, s)); });
}

Measurement cotangent_beats_deficit(ClaimBench& bench, const MeshNames&) {
    Measurement m = over_samplings(bench, [](ClaimBench& b, const Sampling& s) { return cotangent_error(b, s) / deficit_error(b, s); });
    m.remark = report::text("Each error is relative to its own quantity.");
    return m;
}

Measurement not_influenced(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    for (const char* surface : {"sphere", "ellipsoid"}) {
        for (const int coarser : {1, 0}) {
            const Sampling s{surface, MeshKind::random};
            const int vertices = bench.panel(s.surface, s.kind, level_of(bench) - coarser).vertices;
            m.cases.push_back(
                {s.words() + ", " + std::to_string(vertices) + " vertices", 100 * error_of(bench, s, Quantity::H, "barycentric", coarser)});
        }
    }
    const Sampling regular{"ellipsoid", MeshKind::regular};
    m.remark = report::text("On regular triangles it is ", readable(100 * cotangent_error(bench, regular)), " % (ellipsoid).");
    if (m.cases[3].value > 0.7 * m.cases[2].value) {
        report::extend(m.remark, " Four times as many random triangles leave the error where it was: pointwise, it does not converge ",
                       report::ref("wardetzky_2008"), ".");
    }
    return m;
}

Measurement uniform_on_flat(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    m.cases = {{"a flat square of irregular triangles", bench.plane().uniform}};
    m.remark = report::text("The true value is 0: what is seen is how far the triangles pull a vertex to one side.");
    return m;
}

Measurement cotangent_on_flat(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    m.cases = {{"a flat square of irregular triangles", bench.plane().cotangent}};
    m.remark = report::text("The uniform operator gives ", readable(bench.plane().uniform, 2), " there.");
    return m;
}

Measurement clamping_is_harmless(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    m.cases = {{"a flat square of irregular triangles", bench.plane().clamped}};
    m.remark = report::text(readable_percent(bench.plane().negative_weights, 2),
                            " of its edges have a negative weight; with them kept the "
                            "largest value is ",
                            readable(bench.plane().cotangent, 2), ".");
    return m;
}

// ---- the plane of the assignment --------------------------------------------------------------------------------------------

Measurement structure_on_plane(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const CotangentComparison c = compare_operators(bench.mesh("plane").mesh);
    m.cases = {{"cotangent H inside", c.precision}, {"uniform H inside", c.drift}};
    if (std::max(c.precision, c.drift) < 0.01) {
        m.remark = report::text("On the boundary, where ½‖Lx‖ is no curvature, the cotangent operator gives ",
                                readable(c.variants.front().boundary), ": any structure in a picture is there.");
    }
    return m;
}

Measurement less_rapid_on_plane(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const CotangentComparison c = compare_operators(bench.mesh("plane").mesh);
    if (c.drift < 1e-9 && c.precision < 1e-9) {
        m.undecidable = "the mesh is flat and regular, both estimates are zero to rounding inside, and a ratio of the two says nothing";
        return m;
    }
    m.cases = {{"inside", c.jump_cotangent / c.jump_uniform}};
    return m;
}

Measurement uniform_on_plane(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const CotangentComparison c = compare_operators(bench.mesh("plane").mesh);
    m.cases = {{"inside", c.drift}};
    if (c.drift < 0.001)
        m.remark = report::text("Its vertices lie in the middle of their neighbours, where the uniform operator is exact.");
    return m;
}

// ---- the ellipsoid ----------------------------------------------------------------------------------------------------------

Measurement parameters_of_the_tip(ClaimBench&, const MeshNames&) {
    Measurement m;
    const Vector3 tip(flat_ellipsoid.a, 0, 0);
    m.cases = {{"(u, v) = (0, π)", (ellipsoid_point(flat_ellipsoid, 0, M_PI) - tip).norm() / flat_ellipsoid.a}};
    m.remark = report::text("That is the south pole, where the first form is singular. (0, π/2) misses the point by ",
                            readable((ellipsoid_point(flat_ellipsoid, 0, M_PI / 2) - tip).norm() / flat_ellipsoid.a, 2), ".");
    return m;
}

Measurement places_of_extrema(ClaimBench&, const MeshNames&) {
    Measurement m;
    for (const Ellipsoid& e : {tall_ellipsoid, flat_ellipsoid}) {
        m.cases.push_back({std::string(e.b < e.c ? "b < c" : "b > c") + ", " + axes_text(e),
                           tip_curvature_by_angle(e, 0) / tip_curvature_by_angle(e, M_PI / 2)});
    }
    m.remark = report::text("By the formula of Euler the value is a/b² at 0 and π, a/c² at π/2 and 3π/2.");
    return m;
}

}   // namespace

const std::vector<Claim>& curvature_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    constexpr std::string_view ratio_of_errors = "the relative L2 error of the one over that of the other";
    constexpr std::string_view inside = "the largest |H| × mean edge inside";
    static const std::vector<Claim> claims{
        {"claims_s0_uniform",
         "S0",
         "",
         "q1",
         "Uniform mean curvature is a quite inaccurate estimate.",
         {},
         {"the relative L2 error of uniform H", "%", at_least, 10},
         Effort::quick,
         uniform_inaccurate},
        {"claims_s0_drift",
         "S0",
         "",
         "q1",
         "Irregular triangles give a flat mesh a uniform mean curvature that is not zero.",
         {},
         {inside, "", at_least, 0.01},
         Effort::quick,
         uniform_on_flat},
        {"claims_s1_deficit",
         "S1",
         "",
         "q1",
         "Gaussian curvature by angle deficits is a better estimate than uniform mean curvature.",
         {},
         {ratio_of_errors, "", at_most, 1},
         Effort::quick,
         deficit_beats_uniform},
        {"claims_s3_plane_uniform",
         "S3",
         "",
         "q1",
         "The uniform operator works well on a simple mesh such as the plane.",
         {{"plane"}, its_kind, {Property::flat}},
         {inside, "", at_most, 0.001},
         Effort::quick,
         uniform_on_plane},
        {"claims_s3_plane_structure",
         "S3",
         "",
         "q1",
         "The mean curvature of the plane shows where it bends.",
         {{"plane"}, itself, {Property::flat}},
         {inside, "", at_least, 0.01},
         Effort::quick,
         structure_on_plane},
        {"claims_s3_tip",
         "S3",
         "",
         "q2",
         "The point (a, 0, 0) has the parameters (0, π).",
         {},
         {"the distance between that point of the ellipsoid and (a, 0, 0), over a", "", at_most, 1e-9},
         Effort::quick,
         parameters_of_the_tip},
        {"claims_s3_extrema",
         "S3",
         "",
         "q2",
         "The normal curvature at (a, 0, 0) is largest at 0, π and 2π and smallest at π/2 and 3π/2.",
         {},
         {"the normal curvature at 0 over that at π/2", "", at_least, 1},
         Effort::quick,
         places_of_extrema},
        {"claims_s0_irregular",
         "S0",
         "",
         "q3",
         "Irregular triangulations do not influence the cotangent mean curvature.",
         {},
         {"the relative L2 error of cotangent H on random triangles", "%", at_most, 5},
         Effort::quick,
         not_influenced},
        {"claims_s0_best",
         "S0",
         "",
         "q3",
         "Of uniform H, angle-deficit K and cotangent H, the last is the best estimate.",
         {},
         {"the relative L2 error of cotangent H over the smaller of the other two", "", at_most, 1},
         Effort::quick,
         cotangent_beats_both},
        {"claims_s1_cotangent",
         "S1",
         "",
         "q3",
         "Cotangent mean curvature is far better than uniform mean curvature.",
         {},
         {ratio_of_errors, "", at_most, 0.5},
         Effort::quick,
         cotangent_beats_uniform},
        {"claims_s1_over_deficit",
         "S1",
         "",
         "q3",
         "Cotangent mean curvature is even more accurate than Gaussian curvature.",
         {},
         {ratio_of_errors, "", at_most, 1},
         Effort::quick,
         cotangent_beats_deficit},
        {"claims_s2_artefacts",
         "S2",
         "",
         "q3",
         "Where the surface is flat, what irregular connectivity does to the uniform operator is gone with the cotangent one.",
         {},
         {inside, "", at_most, 1e-9},
         Effort::quick,
         cotangent_on_flat},
        {"claims_s3_clamp",
         "S3",
         "",
         "q3",
         "Setting negative cotangent weights to zero keeps the operator well behaved.",
         {},
         {inside, "", at_most, 1e-9},
         Effort::quick,
         clamping_is_harmless},
        {"claims_s3_plane_rapid",
         "S3",
         "",
         "q3",
         "On the plane, cotangent curvature changes less rapidly than uniform mean curvature.",
         {{"plane"}, itself},
         {"the rms difference of H between neighbours, cotangent over uniform", "", at_most, 1},
         Effort::quick,
         less_rapid_on_plane},
    };
    return claims;
}

}   // namespace meshfolio::claims
