// Claims about implicit smoothing: that it is stable, that it equals explicit smoothing, and what it costs.
#include "geometry/smoothing/dirichlet_energy.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

double energy_left(ClaimBench& bench, std::string_view name, const RunKey& key) {
    const SmoothingSubject& s = bench.subject(name);
    return dirichlet_energy(s.laplacian.C, bench.run(name, key).X) / s.initial_energy;
}

/// Energy left in the run's own operator, which its steps cannot raise. Rounded to a millionth: needles leave rounding errors below.
double own_energy_left(ClaimBench& bench, std::string_view name, const RunKey& key) {
    const TriangleMesh& mesh = bench.subject(name).mesh();
    const SparseMatrix C = laplace_operator(mesh, key.laplacian).C;
    constexpr double digits = 1e6;
    return std::round(digits * dirichlet_energy(C, bench.run(name, key).X) / dirichlet_energy(C, mesh.X)) / digits;
}

Measurement stable_on_bunny(ClaimBench& bench, const MeshNames&) {
    const auto share = [&](double lambda) { return readable(bench.raw_step("bunny", lambda) / bench.subject("bunny").critical); };
    const auto left = [&](const std::pair<double, int>& run) {
        const auto& [lambda, iterations] = run;
        return Case{words.line("claims_s0_stable.case", "share"_a = share(lambda), "iterations"_a = iterations),
                    own_energy_left(bench, "bunny", {implicit_euler, bench.raw_step("bunny", lambda), iterations})};
    };
    return {.cases = each_of(std::array{std::pair{1e-6, 10}, std::pair{1e-6, 20}, std::pair{2e-6, 10}}, left),
            .remark = words.say("claims_s0_stable.remark", "times"_a = share(1e-6))};
}

Measurement stable_at_any_step(ClaimBench& bench, const MeshNames&) {
    const double critical = bench.subject("bunny").critical;
    return {.cases = each_of(std::array{1e2, 1e4, 1e6}, [&](double share) {
                return Case{(share == 1e6 ? "10⁶" : readable(share, 1)) + " λ_crit",
                            own_energy_left(bench, "bunny", {implicit_euler, share * critical, 1})};
            })};
}

Measurement stable_at_five(ClaimBench& bench, const MeshNames&) {
    const RunKey key{implicit_euler, 5, 10, OperatorKind::uniform};
    return {.cases = {{words.line("claims_s3_five_stable.case"), own_energy_left(bench, "fandisk_ns", key)}},
            .remark = words.say("claims_s3_five_stable.remark", "limit"_a = readable(bench.uniform_limit("fandisk_ns"), 4))};
}

/// How far two results are apart, in % of how far the first moved.
double gap(ClaimBench& bench, std::string_view name, const RunKey& a, const RunKey& b) {
    return 100 * vertex_rms(bench.run(name, a).X, bench.run(name, b).X) / bench.motion(name, a);
}

Measurement same_as_explicit(ClaimBench& bench, const MeshNames&) {
    const SmoothingSubject& s = bench.subject("bunny");
    const double step = bench.raw_step("bunny", 1e-7), near_limit = 0.95 * s.critical;
    const auto compared = [&](const std::string& share, double lambda) {
        return Case{words.line("claims_s1_same_as_explicit.case", "share"_a = share),
                    gap(bench, "bunny", {explicit_euler, lambda, 100}, {implicit_euler, lambda, 100})};
    };
    Measurement m{.cases = {compared(readable(step / s.critical, 2), step), compared("0.95", near_limit)}};
    const double moved = bench.motion("bunny", {explicit_euler, step, 100});
    m.remark = words.say("claims_s1_same_as_explicit.remark", "apart"_a = readable_percent(m.cases[0].value / 100 * moved / s.diagonal, 2),
                         "moved"_a = readable_percent(moved / s.diagonal, 2));
    return m;
}

/// The gap between 100 steps of λ and fewer steps, `factor` times as large, over the same time.
Case same_time(ClaimBench& bench, int factor) {
    const double step = bench.raw_step("bunny", 1e-7);
    return {words.line("case.same_time", "steps"_a = 100 / factor, "factor"_a = factor),
            gap(bench, "bunny", {implicit_euler, step, 100}, {implicit_euler, factor * step, 100 / factor})};
}

Measurement iterations_for_step(ClaimBench& bench, const MeshNames&) {
    Measurement m{.cases = each_of(std::array{2, 10, 100}, [&](int factor) { return same_time(bench, factor); })};
    const double moved = bench.motion("bunny", {implicit_euler, bench.raw_step("bunny", 1e-7), 100});
    m.remark = words.say("claims_s3_iterations_for_step.remark",
                         "apart"_a = readable_percent(m.cases[2].value / 100 * moved / bench.subject("bunny").diagonal, 2));
    return m;
}

Measurement too_large_deviates(ClaimBench& bench, const MeshNames&) {
    return {.cases = each_of(std::array{10, 100}, [&](int factor) { return same_time(bench, factor); })};
}

/// ‖S(X + Y) − S(X) − S(Y)‖ over ‖S(X + Y)‖, for one implicit step S and Y the positions with their axes exchanged.
Measurement non_linear_solver(ClaimBench& bench, const MeshNames&) {
    const SmoothingSubject& s = bench.subject("cube");
    const Positions X = s.mesh().X.rowwise() - s.mesh().X.row(0);
    Positions Y(X.rows(), 3);
    Y << X.col(1), X.col(2), X.col(0).cwiseAbs2() / s.diagonal;
    const double lambda = 10 * s.critical;
    const Positions sum = X + Y, together = implicit_step(s.laplacian, lambda, sum);
    return {
        .cases = {{words.line("claims_s0_nonlinear.case"),
                   (together - implicit_step(s.laplacian, lambda, X) - implicit_step(s.laplacian, lambda, Y)).norm() / together.norm()}},
        .remark = words.say("claims_s0_nonlinear.remark")};
}

/// Explicit steps at 0.95 λ_crit until no more Dirichlet energy is left than `share` of the input's; 0: not within 3000.
int explicit_steps_to(ClaimBench& bench, std::string_view name, double share) {
    const SmoothingSubject& s = bench.subject(name);
    int steps = 0;
    SmoothingOptions options{.lambda = 0.95 * s.critical, .iterations = 3000};
    options.after_step = [&](int iteration, const Positions& X) {
        // The energy costs as much as a step, so it is computed every tenth.
        if (iteration % 10 == 0 && dirichlet_energy(s.laplacian.C, X) <= share * s.initial_energy) steps = iteration;
        return steps == 0;
    };
    smooth(s.mesh(), options);
    return steps;
}

/// Ten implicit steps of 50 limits, and the explicit ones that smooth as much.
struct EqualSmoothing {
    int implicit_steps = 10, explicit_steps = 0;   // 0: not reached
    double operations = NAN;                       // implicit over explicit
};
EqualSmoothing equal_smoothing(ClaimBench& bench, std::string_view name) {
    EqualSmoothing equal;
    const RunKey key{implicit_euler, 50 * bench.subject(name).critical, equal.implicit_steps};
    equal.explicit_steps = explicit_steps_to(bench, name, energy_left(bench, name, key));
    if (equal.explicit_steps > 0)
        equal.operations = implicit_operations(bench.run(name, key), equal.implicit_steps) /
                           explicit_operations(bench.subject(name), equal.explicit_steps);
    return equal;
}

Measurement implicit_is_cheaper(ClaimBench& bench, const MeshNames&) {
    const SmoothingSubject& s = bench.subject("bunny");
    const Smoothed& run = bench.run("bunny", {implicit_euler, 0.5 * s.critical, 100});
    return {.cases = {{words.line("claims_s0_cheaper.case.same_step"), implicit_operations(run, 100) / explicit_operations(s, 100)},
                      {words.line("claims_s0_cheaper.case.same_energy"), equal_smoothing(bench, "bunny").operations}},
            .remark = words.say("claims_s0_cheaper.remark")};
}

Measurement fewer_iterations(ClaimBench& bench, const MeshNames&) {
    const EqualSmoothing equal = equal_smoothing(bench, "bunny");
    if (equal.explicit_steps == 0) return {.undecidable = words.line("claims_s0_fewer_iterations.undecidable")};
    return {
        .cases = {{words.line("claims_s0_fewer_iterations.case"), double(equal.implicit_steps) / equal.explicit_steps}},
        .remark = words.say("claims_s0_fewer_iterations.remark", "implicit"_a = equal.implicit_steps, "explicit"_a = equal.explicit_steps)};
}

Measurement smooths_more(ClaimBench& bench, const MeshNames&) {
    const auto ratio = [&](const RunKey& a, const RunKey& b) { return energy_left(bench, "bunny", a) / energy_left(bench, "bunny", b); };
    const auto at_share = [&](double share) {
        const double lambda = share * bench.subject("bunny").critical;
        return Case{words.line("claims_s2_smooths_more.case", "share"_a = plain_text(share)),
                    ratio({implicit_euler, lambda, 100}, {explicit_euler, lambda, 100})};
    };
    Measurement m{.cases = each_of(std::array{0.05, 0.5, 0.95}, at_share), .remark = words.say("claims_s2_smooths_more.remark")};
    if (bench.is_itself("bunny"))   // steps of the report
        m.cases.push_back({words.line("claims_s2_smooths_more.case.report"),
                           ratio({implicit_euler, 5e-8, 100}, {explicit_euler, 0.005, 100, OperatorKind::uniform})});
    return m;
}

}   // namespace

extern const std::vector<Claim> implicit_claims{
    {"claims_s0_stable", "q6", {{"bunny"}}, {"energy", "", at_most, 1}, stable_on_bunny},
    {"claims_s0_too_large", "q6", {{"bunny"}}, {"apart", "%", at_least, 5}, too_large_deviates, full},
    {"claims_s0_nonlinear", "q6", {{"cube"}}, {"superposition", "", at_least, 1e-9}, non_linear_solver},
    {"claims_s0_cheaper", "q6", {{"bunny"}}, {"operations", "", at_most, 0.5}, implicit_is_cheaper, full},
    {"claims_s0_fewer_iterations", "q6", {{"bunny"}}, {"iterations", "", at_most, 0.5}, fewer_iterations, full},
    {"claims_s1_any_step", "q6", {{"bunny"}}, {"energy", "", at_most, 1}, stable_at_any_step},
    {"claims_s1_same_as_explicit", "q6", {{"bunny"}}, {"apart", "%", at_most, 5}, same_as_explicit, full},
    {"claims_s2_smooths_more", "q6", {{"bunny"}}, {"energies", "", at_most, 0.99}, smooths_more, full},
    {"claims_s3_five_stable", "q6", {{"fandisk_ns"}}, {"energy", "", at_most, 1}, stable_at_five, full},
    {"claims_s3_iterations_for_step", "q6", {{"bunny"}}, {"apart", "%", at_most, 10}, iterations_for_step, full}};

}   // namespace meshfolio::claims
