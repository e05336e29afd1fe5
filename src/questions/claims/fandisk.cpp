// Claims about smoothing the noisy plane and the noisy machine part with the uniform and with the cotangent operator.
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

/// The errors left on a noisy mesh by runs that differ in λ alone; on the plane only heights count.
Sweep sweep_of(ClaimBench& bench, std::string_view name, RunKey key, std::vector<double> lambdas) {
    const Positions clean = bench.clean_form(name).value();   // the claim asks for it
    const auto error_of = [&](const Positions& X) {
        return name == "plane_ns" ? std::sqrt((X.col(2) - clean.col(2)).squaredNorm() / double(X.rows())) : vertex_rms(X, clean);
    };
    Sweep sweep{std::move(lambdas), {}, error_of(bench.mesh(name).mesh->mesh().X)};
    for (const double lambda : sweep.steps) {
        key.lambda = lambda;
        sweep.errors.push_back(error_of(bench.run(name, key).X));
    }
    return sweep;
}

/// Compares the error at this λ with that at the best of five.
Measure good_step(double lambda) {
    return [=](ClaimBench& bench, const MeshNames& meshes) {
        const auto with = [&](SmoothingScheme scheme) {
            return sweep_of(bench, meshes.front(), {scheme, 0, 10, OperatorKind::uniform}, {0.1, 0.25, 0.5, 0.75, 1.0});
        };
        const Sweep by_explicit = with(explicit_euler), by_implicit = with(implicit_euler);
        Measurement m;
        m.cases = {{"explicit", by_explicit.at(lambda) / by_explicit.least()}, {"implicit", by_implicit.at(lambda) / by_implicit.least()}};
        m.remark =
            words.say("best_steps", "explicit"_a = plain_text(by_explicit.best_step()), "implicit"_a = plain_text(by_implicit.best_step()));
        return m;
    };
}

/// Best of several implicit steps with either operator, on the noisy machine part.
struct OperatorSweeps {
    Sweep uniform, cotangent;
    double edge = 0;   // mean [length]
};
OperatorSweeps operator_sweeps(ClaimBench& bench) {
    const double edge = bench.mesh("fandisk_ns").mesh->preflight().mean_edge;
    const std::vector<double> uniform{0.1, 0.2, 0.4, 0.8, 1.6};
    // Δ_uniform ≈ h²/4 Δ: the same diffusion with either operator.
    const std::vector<double> cotangent = each_of(uniform, [&](const double lambda) { return lambda * edge * edge / 4; });
    return {sweep_of(bench, "fandisk_ns", {implicit_euler, 0, 3, OperatorKind::uniform}, uniform),
            sweep_of(bench, "fandisk_ns", {implicit_euler, 0, 3, OperatorKind::cotan}, cotangent), edge};
}

Measurement uniform_larger(ClaimBench& bench, const MeshNames&) {
    const OperatorSweeps s = operator_sweeps(bench);
    const double uniform = s.uniform.best_step(), cotangent = s.cotangent.best_step();
    return {
        .cases = {{words.line("claims_s3_uniform_larger.case"), uniform * s.edge * s.edge / 4 / cotangent}},
        .remark = words.say("claims_s3_uniform_larger.remark", "uniform"_a = readable(uniform, 2), "cotangent"_a = readable(cotangent, 2))};
}

Measurement cotangent_better(ClaimBench& bench, const MeshNames&) {
    const OperatorSweeps s = operator_sweeps(bench);
    const auto in_edges = [&](double length) { return readable(length / s.edge, 2); };
    return {.cases = {{words.line("claims_s3_cotangent_denoises.case"), s.cotangent.least() / s.uniform.least()}},
            .remark = words.say("claims_s3_cotangent_denoises.remark", "noise"_a = in_edges(s.uniform.noisy),
                                "uniform"_a = in_edges(s.uniform.least()), "cotangent"_a = in_edges(s.cotangent.least()))};
}

/// The least error of 60 explicit steps of 1 over that of 10 implicit steps of 5, with noise of this share of the mean edge.
Case explicit_over_implicit(ClaimBench& bench, double share) {
    const double sigma = share * bench.mesh("fandisk").mesh->preflight().mean_edge;
    const auto least = [&](SmoothingScheme scheme, double lambda, int iterations) {
        const RunKey key{scheme, lambda, iterations, OperatorKind::uniform, false, {sigma, sigma, sigma}};
        return std::ranges::min(bench.denoised("fandisk", key));
    };
    return {words.line("claims_s3_implicit_needed.case", "share"_a = plain_text(share)),
            least(explicit_euler, 1, 60) / least(implicit_euler, 5, 10)};
}

const Measure noise_needs_implicit = remarked(at_each({0.2, 0.5, 1}, explicit_over_implicit));
const About a_fandisk{{"fandisk_ns"}, {clean_known}, its_kind};

}   // namespace

extern const std::vector<Claim> fandisk_claims{
    {"claims_s3_plane_step", "q5", {{"plane_ns"}, {clean_known}, its_kind}, {"over_best_step", "", at_most, 1.1}, good_step(1)},
    {"claims_s3_fandisk_step", "q5", {{"fandisk_ns"}, {clean_known}, itself}, {"over_best_step", "", at_most, 1.1}, good_step(0.5), full},
    {"claims_s3_implicit_needed", "q7", {{"fandisk"}}, {"least_explicit", "", at_least, 1.1}, noise_needs_implicit, full},
    {"claims_s3_uniform_larger", "q7", a_fandisk, {"best_uniform", "", at_least, 1.5}, uniform_larger, full},
    {"claims_s3_cotangent_denoises", "q7", a_fandisk, {"least_cotangent", "", at_most, 0.9}, cotangent_better, full}};

}   // namespace meshfolio::claims
