// Claims about smoothing the noisy plane and the noisy machine part with the uniform and with the cotangent operator.
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

/// rms error; on the plane only the height counts. [length]
double error_of(const Positions& X, const Positions& clean, bool height_only) {
    return height_only ? std::sqrt((X.col(2) - clean.col(2)).squaredNorm() / double(X.rows())) : vertex_rms(X, clean);
}

Sweep sweep_of(ClaimBench& bench, std::string_view name, const Positions& clean, RunKey key, std::vector<double> lambdas) {
    const bool height_only = name == "plane_ns";
    Sweep sweep{std::move(lambdas), {}, error_of(bench.mesh(name).mesh->mesh().X, clean, height_only)};
    for (const double lambda : sweep.steps) {
        key.lambda = lambda;
        sweep.errors.push_back(error_of(bench.run(name, key).X, clean, height_only));
    }
    return sweep;
}

Measurement good_step(ClaimBench& bench, std::string_view name, double lambda) {
    const Positions clean = bench.clean_form(name).value();   // the claim asks for it
    const auto with = [&](SmoothingScheme scheme) {
        return sweep_of(bench, name, clean, {scheme, 0, 10, OperatorKind::uniform}, {0.1, 0.25, 0.5, 0.75, 1.0});
    };
    const Sweep explicitly = with(explicit_euler), implicitly = with(implicit_euler);
    return {.cases = {{"explicit", explicitly.at(lambda) / explicitly.least()}, {"implicit", implicitly.at(lambda) / implicitly.least()}},
            .remark = words.say("best_steps", "explicit"_a = plain_text(explicitly.best_step()),
                                "implicit"_a = plain_text(implicitly.best_step()))};
}

Measurement plane_at_one(ClaimBench& bench, const MeshNames&) { return good_step(bench, "plane_ns", 1); }
Measurement fandisk_at_half(ClaimBench& bench, const MeshNames&) { return good_step(bench, "fandisk_ns", 0.5); }

/// Best of several implicit steps with either operator, on the noisy machine part.
struct OperatorSweeps {
    Sweep uniform, cotangent;
    double edge = 0;   // mean [length]
};
OperatorSweeps operator_sweeps(ClaimBench& bench) {
    const Positions clean = bench.clean_form("fandisk_ns").value();
    const double edge = bench.mesh("fandisk_ns").mesh->preflight().mean_edge;
    // Δ_uniform ≈ h²/4 Δ: the same diffusion with either operator.
    const std::vector<double> uniform{0.1, 0.2, 0.4, 0.8, 1.6};
    const std::vector<double> cotangent = each_of(uniform, [&](const double lambda) { return lambda * edge * edge / 4; });
    const auto sweep = [&](OperatorKind kind, const std::vector<double>& lambdas) {
        return sweep_of(bench, "fandisk_ns", clean, {implicit_euler, 0, 3, kind}, lambdas);
    };
    return {sweep(OperatorKind::uniform, uniform), sweep(OperatorKind::cotan, cotangent), edge};
}

Measurement uniform_larger(ClaimBench& bench, const MeshNames&) {
    const OperatorSweeps s = operator_sweeps(bench);
    const double uniform = s.uniform.best_step(), cotangent = s.cotangent.best_step();
    return {
        .cases = {{words.line("claims_s3_uniform_larger.case"), uniform * s.edge * s.edge / 4 / cotangent}},
        .remark = words.say("claims_s3_uniform_larger.remark", "uniform"_a = readable(uniform, 2), "cotangent"_a = readable(cotangent, 2))};
}

Measurement cotan_better(ClaimBench& bench, const MeshNames&) {
    const OperatorSweeps s = operator_sweeps(bench);
    const auto in_edges = [&](double length) { return readable(length / s.edge, 2); };
    return {.cases = {{words.line("claims_s3_cotangent_denoises.case"), s.cotangent.least() / s.uniform.least()}},
            .remark = words.say("claims_s3_cotangent_denoises.remark", "noise"_a = in_edges(s.uniform.noisy),
                                "uniform"_a = in_edges(s.uniform.least()), "cotangent"_a = in_edges(s.cotangent.least()))};
}

/// The least error along a run.
double least_error(ClaimBench& bench, double sigma, SmoothingScheme scheme, double lambda, int iterations) {
    return std::ranges::min(bench.denoised("fandisk", {.sigma = Vector3::Constant(sigma),
                                                       .lambda = lambda,
                                                       .iterations = iterations,
                                                       .scheme = scheme,
                                                       .laplacian = OperatorKind::uniform}));
}

Measurement noise_needs_implicit(ClaimBench& bench, const MeshNames&) {
    const double edge = bench.mesh("fandisk").mesh->preflight().mean_edge;
    const auto compared = [&](double share) {
        return Case{words.line("claims_s3_implicit_needed.case", "share"_a = plain_text(share)),
                    least_error(bench, share * edge, explicit_euler, 1, 60) / least_error(bench, share * edge, implicit_euler, 5, 10)};
    };
    return {.cases = each_of(std::array{0.2, 0.5, 1.0}, compared), .remark = words.say("claims_s3_implicit_needed.remark")};
}

}   // namespace

extern const std::vector<Claim> fandisk_claims{
    {"claims_s3_plane_step", "q5", {{"plane_ns"}, {clean_known}, its_kind}, {"over_best_step", "", at_most, 1.1}, plane_at_one},
    {"claims_s3_fandisk_step", "q5", {{"fandisk_ns"}, {clean_known}, itself}, {"over_best_step", "", at_most, 1.1}, fandisk_at_half, full},
    {"claims_s3_implicit_needed", "q7", {{"fandisk"}}, {"least_explicit", "", at_least, 1.1}, noise_needs_implicit, full},
    {"claims_s3_uniform_larger",
     "q7",
     {{"fandisk_ns"}, {clean_known}, its_kind},
     {"best_uniform", "", at_least, 1.5},
     uniform_larger,
     full},
    {"claims_s3_cotangent_denoises",
     "q7",
     {{"fandisk_ns"}, {clean_known}, its_kind},
     {"least_cotangent", "", at_most, 0.9},
     cotan_better,
     full}};

}   // namespace meshfolio::claims
