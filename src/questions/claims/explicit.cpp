// Claims about explicit smoothing: which step is good, and what a larger one does.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"

namespace meshfolio::claims {

namespace {

using enum SmoothingScheme;

/// A step as a share of the limit of the operator with ½, and of that without it, whose L is twice as large.
std::vector<Case> shares_of_limit(ClaimBench& bench, std::string_view name, double lambda) {
    const double share = lambda / bench.subject(name).critical;
    return {{"C with the factor ½", share}, {"C without it, as the report prints it", 2 * share}};
}

Measurement bunny_limit(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    m.cases = shares_of_limit(bench, "bunny", 2e-7);
    m.remark = report::text("The limit itself is ", readable(bench.subject("bunny").critical), " length² with ½.");
    return m;
}

/// The first step whose λμ_max exceeds 2 when L is rebuilt from the current positions, and the largest λμ_max seen until then.
struct Crossing {
    int step = 0;
    double product = 0;
};
Crossing crossing_when_rebuilt(ClaimBench& bench, std::string_view name, double lambda, int most) {
    Crossing crossing;
    SmoothingOptions options;
    options.lambda = lambda;
    options.iterations = most;
    options.rebuild = options.monitor = true;
    options.after_step = [](int, const Positions&) { return true; };
    const Smoothed flow = smooth(bench.mesh(name).mesh->mesh(), options);
    for (const StepStability& step : flow.steps) crossing.product = std::max(crossing.product, step.top);
    crossing.step = flow.crossing_iteration;
    return crossing;
}

Measurement bunny_zigzag(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double lambda = bench.raw_step("bunny", 1e-7), share = lambda / bench.subject("bunny").critical;
    m.cases = {{"the operator of the input, with ½", share}, {"the same without ½", 2 * share}};
    // Fifty steps tell: what crosses the limit does so early, and each takes an eigenvalue.
    const Crossing crossing = crossing_when_rebuilt(bench, "bunny", lambda, bench.settings().laboratory ? 100 : 50);
    m.cases.push_back({"L rebuilt from the current positions, with ½", crossing.product / 2});
    if (crossing.step > 0) {
        m.remark = report::text("Rebuilt, the operator crosses its limit in step ", std::to_string(crossing.step),
                                ": the zigzags need no step that was too large at the start.");
    }
    return m;
}

/// Half-width of the last finite positions of a run, in box diagonals of the mesh.
double reach(ClaimBench& bench, std::string_view name, const RunKey& key) {
    const TriangleMesh& mesh = bench.mesh(name).mesh->mesh();
    const Box box = bounding_box(mesh);
    const Positions& X = bench.run(name, key).X;
    return (X.rowwise() - box.centre().transpose()).rowwise().norm().maxCoeff() / box.diagonal();
}

Measurement bunny_too_large(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    for (const double lambda : {8e-7, 3e-6, 1e-5, 1e-4}) {
        const double step = bench.raw_step("bunny", lambda);
        m.cases.push_back({"λ = " + readable(lambda, 1) + ", " + readable(step / bench.subject("bunny").critical) + " limits",
                           reach(bench, "bunny", {explicit_euler, step, 100})});
    }
    m.remark = report::text("A run is stopped once a vertex is 1000 diagonals away; the larger the step, the sooner that is.");
    return m;
}

/// One step of λ against ten of λ/10, `steps` of the former: roughness left.
double coarse_over_fine(ClaimBench& bench, std::string_view name, double lambda, int steps, OperatorKind kind = OperatorKind::cotan) {
    const SmoothingSubject& s = bench.subject(name);
    return roughness(s, bench.run(name, {explicit_euler, lambda, steps, kind}).X) /
           roughness(s, bench.run(name, {explicit_euler, lambda / 10, 10 * steps, kind}).X);
}

Measurement small_steps(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double critical = bench.subject("bunny").critical;
    double below = 0;
    for (const double share : {0.25, 0.5, 0.9, 1.5}) {
        m.cases.push_back({"λ = " + plain_text(share) + " λ_crit", coarse_over_fine(bench, "bunny", share * critical, 10)});
        if (share < 1) below = std::max(below, std::abs(m.cases.back().value - 1));
    }
    m.remark =
        report::text("Ten steps are compared with a hundred of a tenth of the size. Below the limit that changes what is left by at most ",
                     readable_percent(below, 2), ".");
    return m;
}

Measurement small_uniform_steps(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    for (const double lambda : {0.05, 0.5, 1.0}) {
        m.cases.push_back({"uniform, λ = " + plain_text(lambda), coarse_over_fine(bench, "bunny", lambda, 10, OperatorKind::uniform)});
    }
    m.remark = report::text("0.05 beside 0.005, the report's own pair, is the first case.");
    return m;
}

/// √(mean squared distance of the vertices from their mean). [length]
double size_of(const Positions& X) { return std::sqrt((X.rowwise() - X.colwise().mean()).squaredNorm() / double(X.rows())); }

Measurement cube_too_large(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double step = bench.raw_step("cube", 1e-3);
    m.cases = {{"λ = 10⁻³", 100 * step / bench.subject("cube").critical}};
    const double size = size_of(bench.run("cube", {explicit_euler, step, 100}).X) / size_of(bench.mesh("cube").mesh->mesh().X);
    m.remark = report::text("It is no instability: the mesh shrinks steadily, to ", readable_percent(size), " of its size in 100 steps.");
    return m;
}

Measurement cube_deforms(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double step = bench.raw_step("cube", 1e-3), before = size_of(bench.mesh("cube").mesh->mesh().X);
    for (const int t : {1, 10, 100}) {
        m.cases.push_back({std::to_string(t) + (t == 1 ? " iteration" : " iterations"),
                           100 * (1 - size_of(bench.run("cube", {explicit_euler, step, t}).X) / before)});
    }
    m.remark = report::text("The report does not say how many iterations it took.");
    return m;
}

Measurement limits_differ(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    const auto limit = [&](std::string_view name) {   // [squared mean edges]
        const SmoothingSubject& subject = bench.subject(name);
        return subject.critical / (subject.mean_edge * subject.mean_edge);
    };
    const double first = limit(meshes.front());
    for (std::size_t i = 1; i < meshes.size(); ++i) {
        const double other = limit(meshes[i]);
        m.cases.push_back({bench.mesh(meshes.front()).mesh->name + " and " + bench.mesh(meshes[i]).mesh->name,
                           std::max(first, other) / std::min(first, other)});
    }
    m.remark = report::text(
        "λ is an area, so that size alone changes it; in squared mean edges size is taken out, and what is left is the "
        "triangulation, sometimes a single vertex of it.");
    return m;
}

}   // namespace

const std::vector<Claim>& explicit_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    static const std::vector<Claim> claims{
        {"claims_s0_bunny_limit",
         "S0",
         "",
         "q5",
         "On the bunny, explicit steps below about 2 × 10⁻⁷ are good ones.",
         {{"bunny"}, itself},
         {"λ = 2 × 10⁻⁷ over the largest stable λ", "", at_most, 1.05},
         Effort::quick,
         bunny_limit},
        {"claims_s0_bunny_zigzag",
         "S0",
         "",
         "q5",
         "Even 100 steps of 10⁻⁷ leave zigzags on the bunny.",
         {{"bunny"}, itself},
         {"the step over the limit of the operator in use, at its largest along the run", "", at_least, 1},
         Effort::full,
         bunny_zigzag},
        {"claims_s0_bunny_too_large",
         "S0",
         "",
         "q5",
         "Steps of 8 × 10⁻⁷ to 10⁻⁴ break the bunny up more and more, until it cannot be recognised.",
         {{"bunny"}, itself},
         {"the distance of the farthest vertex from the centre within 100 iterations", "× the box diagonal", at_least, 1},
         Effort::quick,
         bunny_too_large},
        {"claims_s0_small_steps",
         "S0",
         "",
         "q5",
         "For the same amount of smoothing, small steps and many iterations are better than large steps and few.",
         {{"bunny"}},
         {"the roughness left by large steps over that left by small ones, at equal λ × iterations", "", at_least, 1.05},
         Effort::quick,
         small_steps},
        {"claims_s0_cube_too_large",
         "S0",
         "",
         "q5",
         "On the cube, λ = 10⁻³ is already too large a step.",
         {{"cube"}, itself},
         {"λ over the largest stable λ", "%", at_least, 100},
         Effort::quick,
         cube_too_large},
        {"claims_s0_cube_deforms",
         "S0",
         "",
         "q5",
         "From λ = 10⁻³ on, smoothing deforms the cube considerably.",
         {{"cube"}, itself},
         {"how much the mesh shrinks, by the rms distance of its vertices from their mean", "%", at_least, 10},
         Effort::quick,
         cube_deforms},
        {"claims_s0_limits_differ",
         "S0",
         "",
         "q5",
         "Each object needs a step of its own.",
         {{"bunny", "cube", "cow"}, any_mesh, {}, 2},
         {"the larger of two limits over the smaller, each in squared mean edges", "", at_least, 2},
         Effort::quick,
         limits_differ},
        {"claims_s2_small_steps",
         "S2",
         "",
         "q5",
         "The best results come from very small steps and very many iterations.",
         {{"bunny"}},
         {"the roughness left by large steps over that left by small ones, at equal λ × iterations", "", at_least, 1.05},
         Effort::full,
         small_uniform_steps},
    };
    return claims;
}

}   // namespace meshfolio::claims
