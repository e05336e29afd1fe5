// Claims about implicit smoothing: that it is stable, that it equals explicit smoothing, and what it costs.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"
#include "questions/core/section_tools.h"

namespace meshfolio::claims {

namespace {

using enum SmoothingScheme;

double energy_left(ClaimBench& bench, std::string_view name, const RunKey& key) {
    const SmoothingSubject& s = bench.subject(name);
    return dirichlet_energy(s.laplacian.C, bench.run(name, key).X) / s.initial_energy;
}

/// In the energy of the run's own operator, the only one that its steps cannot raise; to a millionth, below which needles leave rounding.
double own_energy_left(ClaimBench& bench, std::string_view name, const RunKey& key) {
    const TriangleMesh& mesh = bench.subject(name).mesh();
    const SparseMatrix C = laplace_operator(mesh, key.laplacian).C;
    constexpr double digits = 1e6;
    return std::round(digits * dirichlet_energy(C, bench.run(name, key).X) / dirichlet_energy(C, mesh.X)) / digits;
}

Measurement stable_on_bunny(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    struct Pair {
        double lambda;
        int iterations;
    };
    for (const Pair p : {Pair{1e-6, 10}, Pair{1e-6, 20}, Pair{2e-6, 10}}) {
        const double lambda = bench.raw_step("bunny", p.lambda);
        m.cases.push_back({readable(lambda / bench.subject("bunny").critical) + " λ_crit, " + std::to_string(p.iterations) + " iterations",
                           own_energy_left(bench, "bunny", {implicit_euler, lambda, p.iterations})});
    }
    m.remark = report::text("Explicit steps of this size are ", readable(bench.raw_step("bunny", 1e-6) / bench.subject("bunny").critical),
                            " times their limit or more. Each mode is divided by 1 + λμ, and that is never below 1.");
    return m;
}

Measurement stable_at_any_step(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    for (const double share : {1e2, 1e4, 1e6}) {
        const double lambda = share * bench.subject("bunny").critical;
        m.cases.push_back({(share == 1e6 ? std::string("10⁶") : readable(share, 1)) + " λ_crit",
                           own_energy_left(bench, "bunny", {implicit_euler, lambda, 1})});
    }
    return m;
}

Measurement stable_at_five(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    m.cases = {
        {"uniform operator, λ = 5, 10 iterations", own_energy_left(bench, "fandisk_ns", {implicit_euler, 5, 10, OperatorKind::uniform})}};
    m.remark = report::text("The explicit limit of this operator is ", readable(bench.uniform_limit("fandisk_ns"), 4), ".");
    return m;
}

/// How far two results are apart, in % of how far the first moved.
double gap(ClaimBench& bench, std::string_view name, const RunKey& a, const RunKey& b) {
    return 100 * vertex_rms(bench.run(name, a).X, bench.run(name, b).X) / bench.motion(name, a);
}

Measurement same_as_explicit(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double step = bench.raw_step("bunny", 1e-7);
    const RunKey explicit_key{explicit_euler, step, 100}, implicit_key{implicit_euler, step, 100};
    const SmoothingSubject& s = bench.subject("bunny");
    m.cases = {{"100 steps of " + readable(step / s.critical, 2) + " λ_crit", gap(bench, "bunny", explicit_key, implicit_key)}};
    m.cases.push_back({"100 steps of 0.95 λ_crit",
                       gap(bench, "bunny", {explicit_euler, 0.95 * s.critical, 100}, {implicit_euler, 0.95 * s.critical, 100})});
    m.remark = report::text(
        "In the first case the two are ", readable_percent(m.cases[0].value / 100 * bench.motion("bunny", explicit_key) / s.diagonal, 2),
        " of the box diagonal apart and both have moved by ", readable_percent(bench.motion("bunny", explicit_key) / s.diagonal, 2), ".");
    return m;
}

/// "100 steps of λ beside 50 of 2 λ": the same time, once in steps `factor` times as large.
std::string runs_text(int factor) {
    return "100 steps of λ beside " + std::to_string(100 / factor) + " of " + std::to_string(factor) + " λ";
}

Measurement iterations_for_step(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double step = bench.raw_step("bunny", 1e-7);
    for (const int factor : {2, 10, 100}) {
        m.cases.push_back(
            {runs_text(factor), gap(bench, "bunny", {implicit_euler, step, 100}, {implicit_euler, factor * step, 100 / factor})});
    }
    const SmoothingSubject& s = bench.subject("bunny");
    m.remark = report::text("For the factor 100 the two results are ",
                            readable_percent(m.cases[2].value / 100 * bench.motion("bunny", {implicit_euler, step, 100}) / s.diagonal, 2),
                            " of the box diagonal apart.");
    return m;
}

/// ‖S(X + Y) − S(X) − S(Y)‖ over ‖S(X + Y)‖, for one implicit step S and Y the positions with their axes exchanged.
Measurement non_linear_solver(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const SmoothingSubject& s = bench.subject("cube");
    const Positions X = s.mesh().X.rowwise() - s.mesh().X.row(0);
    Positions Y(X.rows(), 3);
    Y << X.col(1), X.col(2), X.col(0).cwiseAbs2() / s.diagonal;
    const double lambda = 10 * s.critical;
    const Positions sum = X + Y, together = implicit_step(s.laplacian, lambda, sum);
    m.cases = {{"one step of 10 λ_crit",
                (together - implicit_step(s.laplacian, lambda, X) - implicit_step(s.laplacian, lambda, Y)).norm() / together.norm()}};
    m.remark =
        report::text("The step is a linear system with one symmetric positive definite matrix, M − λC, factored once for all steps.");
    return m;
}

/// Explicit steps at 0.95 λ_crit until no more Dirichlet energy is left than `share` of the input's; 0: not within 3000.
int explicit_steps_to(ClaimBench& bench, std::string_view name, double share) {
    const SmoothingSubject& s = bench.subject(name);
    int steps = 0;
    SmoothingOptions options;
    options.lambda = 0.95 * s.critical;
    options.iterations = 3000;
    options.after_step = [&](int iteration, const Positions& X) {
        // The energy costs as much as a step: looked at every tenth.
        if (iteration % 10 == 0 && dirichlet_energy(s.laplacian.C, X) <= share * s.initial_energy) steps = iteration;
        return steps == 0;
    };
    smooth(s.mesh(), options);
    return steps;
}

/// Ten implicit steps of 50 limits, and the explicit ones that smooth as much.
struct EqualSmoothing {
    int implicit_steps = 10, explicit_steps = 0;
    double implicit_operations = 0, explicit_operations = 0;   // multiply–adds, the factorisation by its lower bound nnz²/n
};
EqualSmoothing equal_smoothing(ClaimBench& bench, std::string_view name) {
    EqualSmoothing equal;
    const RunKey key{implicit_euler, 50 * bench.subject(name).critical, equal.implicit_steps};
    const Smoothed& run = bench.run(name, key);
    equal.explicit_steps = explicit_steps_to(bench, name, energy_left(bench, name, key));
    const auto entries = static_cast<double>(run.factor_nonzeros);
    equal.implicit_operations = 6 * entries * equal.implicit_steps + entries * entries / static_cast<double>(run.X.rows());
    equal.explicit_operations = 3.0 * double(bench.subject(name).laplacian.C.nonZeros()) * equal.explicit_steps;
    return equal;
}

Measurement implicit_is_cheaper(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const SmoothingSubject& s = bench.subject("bunny");
    const auto entries = static_cast<double>(bench.run("bunny", {implicit_euler, 0.5 * s.critical, 100}).factor_nonzeros);
    const double a_step = 3.0 * double(s.laplacian.C.nonZeros());
    m.cases = {{"the same λ and iterations, 100 at 0.5 λ_crit",
                (600 * entries + entries * entries / double(s.mesh().vertex_count())) / (100 * a_step)}};
    const EqualSmoothing equal = equal_smoothing(bench, "bunny");
    m.cases.push_back({"the same energy left, implicit with 50 λ_crit",
                       equal.explicit_steps > 0 ? equal.implicit_operations / equal.explicit_operations : std::nan("")});
    m.remark = report::text(
        "Counted are multiplications: six for each entry of the factor and step, three for each entry of C, and the "
        "factorisation itself by a lower bound.");
    return m;
}

Measurement fewer_iterations(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const EqualSmoothing equal = equal_smoothing(bench, "bunny");
    if (equal.explicit_steps == 0) {
        m.undecidable = "3000 explicit steps do not smooth as much as ten implicit ones of 50 λ_crit";
        return m;
    }
    m.cases = {{"implicit with 50 λ_crit, explicit with 0.95 λ_crit", double(equal.implicit_steps) / equal.explicit_steps}};
    m.remark = report::text(std::to_string(equal.implicit_steps), " implicit iterations leave as much Dirichlet energy as ",
                            std::to_string(equal.explicit_steps), " explicit ones.");
    return m;
}

Measurement smooths_more(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const SmoothingSubject& s = bench.subject("bunny");
    for (const double share : {0.05, 0.5, 0.95}) {
        const double lambda = share * s.critical;
        m.cases.push_back({"the same λ, " + plain_text(share) + " λ_crit", energy_left(bench, "bunny", {implicit_euler, lambda, 100}) /
                                                                               energy_left(bench, "bunny", {explicit_euler, lambda, 100})});
    }
    if (bench.is_itself("bunny")) {   // steps of the report
        m.cases.push_back({"implicit cotangent λ = 5 × 10⁻⁸ beside explicit uniform λ = 0.005, as the report seems to have run them",
                           energy_left(bench, "bunny", {implicit_euler, 5e-8, 100}) /
                               energy_left(bench, "bunny", {explicit_euler, 0.005, 100, OperatorKind::uniform})});
    }
    m.remark = report::text(
        "At equal λ a mode is multiplied by 1 − λμ in an explicit step and by 1/(1 + λμ), which is more, in an implicit "
        "one: implicit smooths less, except for modes that overshoot.");
    return m;
}

Measurement too_large_deviates(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double step = bench.raw_step("bunny", 1e-7);
    for (const int factor : {10, 100}) {
        m.cases.push_back(
            {runs_text(factor), gap(bench, "bunny", {implicit_euler, step, 100}, {implicit_euler, factor * step, 100 / factor})});
    }
    return m;
}

}   // namespace

const std::vector<Claim>& implicit_claims() {
    using enum Rule::Relation;
    constexpr std::string_view energy = "the Dirichlet energy left, of the input";
    constexpr std::string_view apart = "the rms distance between the two results, of how far the first moved";
    static const std::vector<Claim> claims{
        {"claims_s0_stable",
         "S0",
         "",
         "q6",
         "Implicit smoothing is stable where explicit smoothing is not.",
         {{"bunny"}},
         {energy, "", at_most, 1},
         Effort::quick,
         stable_on_bunny},
        {"claims_s0_too_large",
         "S0",
         "",
         "q6",
         "An implicit step may be too large all the same: the result is then off.",
         {{"bunny"}},
         {apart, "%", at_least, 5},
         Effort::full,
         too_large_deviates},
        {"claims_s0_nonlinear",
         "S0",
         "",
         "q6",
         "Implicit smoothing rests on a non-linear solver.",
         {{"cube"}},
         {"what is missing to superposition, ‖S(X + Y) − S(X) − S(Y)‖/‖S(X + Y)‖", "", at_least, 1e-9},
         Effort::quick,
         non_linear_solver},
        {"claims_s0_cheaper",
         "S0",
         "",
         "q6",
         "Implicit smoothing costs much less.",
         {{"bunny"}},
         {"implicit operations over explicit ones", "", at_most, 0.5},
         Effort::full,
         implicit_is_cheaper},
        {"claims_s0_fewer_iterations",
         "S0",
         "",
         "q6",
         "Implicit smoothing takes larger steps and needs fewer iterations.",
         {{"bunny"}},
         {"implicit iterations over explicit ones, for the same Dirichlet energy", "", at_most, 0.5},
         Effort::full,
         fewer_iterations},
        {"claims_s1_any_step",
         "S1",
         "",
         "q6",
         "Implicit smoothing stays stable whatever λ.",
         {{"bunny"}},
         {energy, "", at_most, 1},
         Effort::quick,
         stable_at_any_step},
        {"claims_s1_same_as_explicit",
         "S1",
         "",
         "q6",
         "With the same λ, explicit and implicit results look identical.",
         {{"bunny"}},
         {apart, "%", at_most, 5},
         Effort::full,
         same_as_explicit},
        {"claims_s2_smooths_more",
         "S2",
         "",
         "q6",
         "Implicit smoothing smooths more in fewer iterations than explicit smoothing.",
         {{"bunny"}},
         {"the Dirichlet energy left by 100 implicit iterations over that left by 100 explicit ones", "", at_most, 0.99},
         Effort::full,
         smooths_more},
        {"claims_s3_five_stable",
         "S3",
         "",
         "q6",
         "Implicit smoothing is stable at λ = 5.",
         {{"fandisk_ns"}},
         {energy, "", at_most, 1},
         Effort::full,
         stable_at_five},
        {"claims_s3_iterations_for_step",
         "S3",
         "",
         "q6",
         "More iterations have the effect of a larger λ.",
         {{"bunny"}},
         {apart, "%", at_most, 10},
         Effort::full,
         iterations_for_step},
    };
    return claims;
}

}   // namespace meshfolio::claims
