// Claims about smoothing the noisy plane and the noisy machine part of the assignment with the uniform operator, and with the cotangent
// one.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"

namespace meshfolio::claims {

namespace {

using enum SmoothingScheme;

/// rms error [length]; of the plane, the height alone.
double error_of(const Positions& X, const Positions& clean, bool height_only) {
    return height_only ? std::sqrt((X.col(2) - clean.col(2)).squaredNorm() / double(X.rows())) : vertex_rms(X, clean);
}

struct Sweep {
    std::vector<double> lambdas, errors;
    double noisy = 0;
    std::size_t best() const { return static_cast<std::size_t>(best_of(errors)); }
    double at(double lambda) const {
        return errors[static_cast<std::size_t>(std::find(lambdas.begin(), lambdas.end(), lambda) - lambdas.begin())];
    }
};
Sweep sweep_of(ClaimBench& bench, std::string_view name, const Positions& clean, RunKey key, std::vector<double> lambdas) {
    const bool height_only = name == "plane_ns";
    Sweep sweep{std::move(lambdas), {}, error_of(bench.mesh(name).mesh->mesh().X, clean, height_only)};
    for (const double lambda : sweep.lambdas) {
        key.lambda = lambda;
        sweep.errors.push_back(error_of(bench.run(name, key).X, clean, height_only));
    }
    return sweep;
}

const std::vector<double> explicit_steps{0.1, 0.25, 0.5, 0.75, 1.0};

Measurement good_step(ClaimBench& bench, std::string_view name, double lambda) {
    Measurement m;
    const Positions clean = bench.clean_form(name).value();   // the claim asks for it
    for (const SmoothingScheme scheme : {explicit_euler, implicit_euler}) {
        const Sweep sweep = sweep_of(bench, name, clean, {scheme, 0, 10, OperatorKind::uniform}, explicit_steps);
        m.cases.push_back({scheme == explicit_euler ? "explicit" : "implicit", sweep.at(lambda) / sweep.errors[sweep.best()]});
        report::extend(m.remark, m.remark.empty() ? "Best of the steps tried: " : ", ", plain_text(sweep.lambdas[sweep.best()]),
                       scheme == explicit_euler ? " explicit" : " implicit.");
    }
    return m;
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
    const double edge = bench.mesh("fandisk_ns").mesh->prepared->preflight.mean_edge;
    // Δ_uniform ≈ h²/4 Δ: the same diffusion with either operator.
    const std::vector<double> uniform{0.1, 0.2, 0.4, 0.8, 1.6};
    std::vector<double> cotangent;
    for (const double lambda : uniform) cotangent.push_back(lambda * edge * edge / 4);
    const auto sweep = [&](OperatorKind kind, const std::vector<double>& lambdas) {
        return sweep_of(bench, "fandisk_ns", clean, {implicit_euler, 0, 3, kind}, lambdas);
    };
    return {sweep(OperatorKind::uniform, uniform), sweep(OperatorKind::cotan, cotangent), edge};
}

Measurement uniform_needs_larger(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const OperatorSweeps s = operator_sweeps(bench);
    const double uniform = s.uniform.lambdas[s.uniform.best()], cotangent = s.cotangent.lambdas[s.cotangent.best()];
    m.cases = {{"as the same diffusion, λ_uniform h̄²/4 beside λ", uniform * s.edge * s.edge / 4 / cotangent}};
    m.remark = report::text("Best of the steps tried in three iterations: ", readable(uniform, 2), " uniform, ", readable(cotangent, 2),
                            " length² cotangent. One has no unit, the other is an area: as bare numbers they depend on the mesh's unit of "
                            "length and say nothing of each other.");
    return m;
}

Measurement cotangent_denoises_better(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const OperatorSweeps s = operator_sweeps(bench);
    m.cases = {{"each operator with its best step", s.cotangent.errors[s.cotangent.best()] / s.uniform.errors[s.uniform.best()]}};
    m.remark = report::text("The noise itself is ", readable(s.uniform.noisy / s.edge, 2), " mean edges rms; the best results leave ",
                            readable(s.uniform.errors[s.uniform.best()] / s.edge, 2), " (uniform) and ",
                            readable(s.cotangent.errors[s.cotangent.best()] / s.edge, 2), " (cotangent).");
    return m;
}

/// The least error along a run.
double least_error(ClaimBench& bench, double sigma, SmoothingScheme scheme, double lambda, int iterations) {
    NoisyKey key;
    key.sigma = Vector3::Constant(sigma);
    key.scheme = scheme;
    key.lambda = lambda;
    key.iterations = iterations;
    key.laplacian = OperatorKind::uniform;
    const std::vector<double> errors = bench.denoised("fandisk", key);
    return errors[static_cast<std::size_t>(best_of(errors))];
}

Measurement noise_needs_implicit(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double edge = bench.mesh("fandisk").mesh->prepared->preflight.mean_edge;
    for (const double share : {0.2, 0.5, 1.0}) {
        m.cases.push_back({"noise of " + plain_text(share) + " mean edges", least_error(bench, share * edge, explicit_euler, 1, 60) /
                                                                                least_error(bench, share * edge, implicit_euler, 5, 10)});
    }
    m.remark = report::text("Explicit steps of 1, at most 60 of them, beside implicit ones of 5, at most 10.");
    return m;
}

}   // namespace

const std::vector<Claim>& fandisk_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    constexpr std::string_view over_best = "the rms error after 10 iterations over that of the best step tried";
    static const std::vector<Claim> claims{
        {"claims_s3_plane_step",
         "S3",
         "",
         "q5",
         "For the noisy plane, λ = 1 of the uniform operator is a good step.",
         {{"plane_ns"}, its_kind, {Property::clean_form_known}},
         {over_best, "", at_most, 1.1},
         Effort::quick,
         plane_at_one},
        {"claims_s3_fandisk_step",
         "S3",
         "",
         "q5",
         "For the noisy fandisk, λ = 0.5 is good, as more would take its features away.",
         {{"fandisk_ns"}, itself, {Property::clean_form_known}},
         {over_best, "", at_most, 1.1},
         Effort::full,
         fandisk_at_half},
        {"claims_s3_implicit_needed",
         "S3",
         "",
         "q7",
         "More noise needs λ above 1, and therefore implicit smoothing.",
         {{"fandisk"}},
         {"the least rms error with explicit steps over that with implicit ones", "", at_least, 1.1},
         Effort::full,
         noise_needs_implicit},
        {"claims_s3_uniform_larger",
         "S3",
         "",
         "q7",
         "The uniform operator needs a larger λ than the cotangent one.",
         {{"fandisk_ns"}, its_kind, {Property::clean_form_known}},
         {"the best uniform step over the best cotangent one", "", at_least, 1.5},
         Effort::full,
         uniform_needs_larger},
        {"claims_s3_cotangent_denoises",
         "S3",
         "",
         "q7",
         "The cotangent operator denoises much better than the uniform one.",
         {{"fandisk_ns"}, its_kind, {Property::clean_form_known}},
         {"the least rms error with the cotangent operator over that with the uniform one", "", at_most, 0.9},
         Effort::full,
         cotangent_denoises_better},
    };
    return claims;
}

}   // namespace meshfolio::claims
