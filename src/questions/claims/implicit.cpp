// Claims about implicit smoothing: its stability, its difference from explicit smoothing, and its cost.
#include "geometry/smoothing/dirichlet_energy.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

/// Dirichlet energy of the bunny after a run, over that before.
double energy_left(ClaimBench& bench, const RunKey& key) {
    const SmoothingSubject& s = bench.subject("bunny");
    return dirichlet_energy(s.laplacian.C, bench.run("bunny", key).X) / s.initial_energy;
}

/// Dirichlet energy after a run over that before, in the run's own operator, which its steps cannot raise. Rounded to 10⁻⁶, because needles
/// leave rounding errors below.
double own_energy_left(ClaimBench& bench, std::string_view name, const RunKey& key) {
    const TriangleMesh& mesh = bench.subject(name).mesh();
    const SparseMatrix C = laplace_operator(mesh, key.laplacian).C;
    constexpr double digits = 1e6;
    return std::round(digits * dirichlet_energy(C, bench.run(name, key).X) / dirichlet_energy(C, mesh.X)) / digits;
}

Measurement stable_on_bunny(ClaimBench& bench, const MeshNames&) {
    const auto share = [&](double lambda) { return readable(bench.raw_step("bunny", lambda) / bench.subject("bunny").critical); };
    Measurement m{.remark = words.say("claims_s0_stable.remark", "times"_a = share(1e-6))};
    for (const auto& [lambda, iterations] : {std::pair{1e-6, 10}, std::pair{1e-6, 20}, std::pair{2e-6, 10}})
        m.cases.push_back({words.line("claims_s0_stable.case", "share"_a = share(lambda), "iterations"_a = iterations),
                           own_energy_left(bench, "bunny", {implicit_euler, bench.raw_step("bunny", lambda), iterations})});
    return m;
}

Case energy_after_step(ClaimBench& bench, double share) {
    return {(share == 1e6 ? "10⁶" : readable(share, 1)) + " λ_crit",
            own_energy_left(bench, "bunny", {implicit_euler, share * bench.subject("bunny").critical, 1})};
}

Measurement stable_at_five(ClaimBench& bench, const MeshNames&) {
    const RunKey key{implicit_euler, 5, 10, OperatorKind::uniform};
    return {.cases = {{words.line("claims_s3_five_stable.case"), own_energy_left(bench, "fandisk_ns", key)}},
            .remark = words.say("claims_s3_five_stable.remark", "limit"_a = readable(bench.uniform_limit("fandisk_ns"), 4))};
}

/// rms distance between the results of two runs of the bunny, in % of the motion of the first.
double gap(ClaimBench& bench, const RunKey& a, const RunKey& b) {
    return 100 * vertex_rms(bench.run("bunny", a).X, bench.run("bunny", b).X) / bench.motion("bunny", a);
}

Measurement same_as_explicit(ClaimBench& bench, const MeshNames&) {
    const SmoothingSubject& s = bench.subject("bunny");
    const double step = bench.raw_step("bunny", 1e-7), near_limit = 0.95 * s.critical;
    const auto compared = [&](const std::string& share, double lambda) {
        return Case{words.line("claims_s1_same_as_explicit.case", "share"_a = share),
                    gap(bench, {explicit_euler, lambda, 100}, {implicit_euler, lambda, 100})};
    };
    Measurement m{.cases = {compared(readable(step / s.critical, 2), step), compared("0.95", near_limit)}};
    const double moved = bench.motion("bunny", {explicit_euler, step, 100});
    m.remark = words.say("claims_s1_same_as_explicit.remark", "apart"_a = readable_percent(m.cases[0].value / 100 * moved / s.diagonal, 2),
                         "moved"_a = readable_percent(moved / s.diagonal, 2));
    return m;
}

/// The gap between 100 steps of λ and fewer steps, `factor` times as large, over the same time.
Case same_time(ClaimBench& bench, double factor) {
    const double step = bench.raw_step("bunny", 1e-7);
    const int steps = static_cast<int>(100 / factor);
    return {words.line("case.same_time", "steps"_a = steps, "factor"_a = static_cast<int>(factor)),
            gap(bench, {implicit_euler, step, 100}, {implicit_euler, factor * step, steps})};
}

Measurement iterations_for_step(ClaimBench& bench, const MeshNames&) {
    Measurement m = at_each({2, 10, 100}, same_time)(bench, {});
    const double moved = bench.motion("bunny", {implicit_euler, bench.raw_step("bunny", 1e-7), 100});
    m.remark = words.say("claims_s3_iterations_for_step.remark",
                         "apart"_a = readable_percent(m.cases[2].value / 100 * moved / bench.subject("bunny").diagonal, 2));
    return m;
}

/// ‖S(X + Y) − S(X) − S(Y)‖ over ‖S(X + Y)‖, for one implicit step S and Y the positions with their axes exchanged.
Measurement non_linear_solver(ClaimBench& bench, const MeshNames&) {
    const SmoothingSubject& s = bench.subject("cube");
    const Positions X = s.mesh().X.rowwise() - s.mesh().X.row(0);
    Positions Y(X.rows(), 3);
    Y << X.col(1), X.col(2), X.col(0).cwiseAbs2() / s.diagonal;
    const double lambda = 10 * s.critical;
    const Positions sum = X + Y, together = implicit_step(s.laplacian, lambda, sum);
    const double apart = (together - implicit_step(s.laplacian, lambda, X) - implicit_step(s.laplacian, lambda, Y)).norm();
    return {.cases = {{words.line("claims_s0_nonlinear.case"), apart / together.norm()}}, .remarked = true};
}

/// Ten implicit steps of 50 λ_crit on the bunny, and the explicit steps of 0.95 λ_crit that leave no more Dirichlet energy.
struct EqualSmoothing {
    int implicit_steps = 10, explicit_steps = 0;   // 0: more than 3000
    double operations = NAN;                       // implicit over explicit
};
EqualSmoothing equal_smoothing(ClaimBench& bench) {
    EqualSmoothing equal;
    const SmoothingSubject& s = bench.subject("bunny");
    const RunKey key{implicit_euler, 50 * s.critical, equal.implicit_steps};
    const double energy = energy_left(bench, key) * s.initial_energy;
    SmoothingOptions options{.lambda = 0.95 * s.critical, .iterations = 3000};
    options.after_step = [&](int iteration, const Positions& X) {
        // The energy costs as much as a step, so it is computed every tenth.
        if (iteration % 10 == 0 && dirichlet_energy(s.laplacian.C, X) <= energy) equal.explicit_steps = iteration;
        return equal.explicit_steps == 0;
    };
    smooth(s.mesh(), options);
    if (equal.explicit_steps > 0)
        equal.operations =
            implicit_operations(bench.run("bunny", key), equal.implicit_steps) / explicit_operations(s, equal.explicit_steps);
    return equal;
}

Measurement implicit_is_cheaper(ClaimBench& bench, const MeshNames&) {
    const SmoothingSubject& s = bench.subject("bunny");
    const Smoothed& run = bench.run("bunny", {implicit_euler, 0.5 * s.critical, 100});
    return {.cases = {{words.line("claims_s0_cheaper.case.same_step"), implicit_operations(run, 100) / explicit_operations(s, 100)},
                      {words.line("claims_s0_cheaper.case.same_energy"), equal_smoothing(bench).operations}},
            .remarked = true};
}

Measurement fewer_iterations(ClaimBench& bench, const MeshNames&) {
    const EqualSmoothing equal = equal_smoothing(bench);
    if (equal.explicit_steps == 0) return {.undecidable = words.line("claims_s0_fewer_iterations.undecidable")};
    return {
        .cases = {{words.line("claims_s0_fewer_iterations.case"), double(equal.implicit_steps) / equal.explicit_steps}},
        .remark = words.say("claims_s0_fewer_iterations.remark", "implicit"_a = equal.implicit_steps, "explicit"_a = equal.explicit_steps)};
}

Measurement smooths_more(ClaimBench& bench, const MeshNames&) {
    const auto ratio = [&](const RunKey& a, const RunKey& b) { return energy_left(bench, a) / energy_left(bench, b); };
    Measurement m{.remarked = true};
    for (const double share : {0.05, 0.5, 0.95}) {
        const double lambda = share * bench.subject("bunny").critical;
        m.cases.push_back({words.line("claims_s2_smooths_more.case", "share"_a = plain_text(share)),
                           ratio({implicit_euler, lambda, 100}, {explicit_euler, lambda, 100})});
    }
    if (bench.is_itself("bunny"))   // steps of the report
        m.cases.push_back({words.line("claims_s2_smooths_more.case.report"),
                           ratio({implicit_euler, 5e-8, 100}, {explicit_euler, 0.005, 100, OperatorKind::uniform})});
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

}   // namespace

extern const std::vector<Claim> implicit_claims{
    {"claims_s0_stable", "q6", {{"bunny"}}, {"energy", "", at_most, 1}, stable_on_bunny},
    {"claims_s0_too_large", "q6", {{"bunny"}}, {"apart", "%", at_least, 5}, at_each({10, 100}, same_time), full},
    {"claims_s0_nonlinear", "q6", {{"cube"}}, {"superposition", "", at_least, 1e-9}, non_linear_solver},
    {"claims_s0_cheaper", "q6", {{"bunny"}}, {"operations", "", at_most, 0.5}, implicit_is_cheaper, full},
    {"claims_s0_fewer_iterations", "q6", {{"bunny"}}, {"iterations", "", at_most, 0.5}, fewer_iterations, full},
    {"claims_s1_any_step", "q6", {{"bunny"}}, {"energy", "", at_most, 1}, at_each({1e2, 1e4, 1e6}, energy_after_step)},
    {"claims_s1_same_as_explicit", "q6", {{"bunny"}}, {"apart", "%", at_most, 5}, same_as_explicit, full},
    {"claims_s2_smooths_more", "q6", {{"bunny"}}, {"energies", "", at_most, 0.99}, smooths_more, full},
    {"claims_s3_five_stable", "q6", {{"fandisk_ns"}}, {"energy", "", at_most, 1}, stable_at_five, full},
    {"claims_s3_iterations_for_step", "q6", {{"bunny"}}, {"apart", "%", at_most, 10}, iterations_for_step, full},
    {"claims_desbrun_one_step", "q6", {{"fandisk_ns"}}, {"implicit_over_explicit", "", at_most, 1}, implicit_step_beats_ten, full}};

}   // namespace meshfolio::claims
