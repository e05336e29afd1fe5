// Claims about denoising by diffusion, on meshes with a known clean form, and about the noise that it can remove.
#include "geometry/operators/vertices_with_mass.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/mesh_class.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

constexpr std::array bunny_sigmas{0.0011, 0.0013, 0.0015};   // of S0's three experiments [length]

/// rms errors along S0's experiment. A stand-in gets the same multiples of its mean edge: the effect of a step on noise depends on the
/// edges.
std::vector<double> bunny_errors(ClaimBench& bench, double sigma, int iterations, OperatorKind kind = OperatorKind::cotan,
                                 bool rebuild = false) {
    constexpr double step = 5e-7;   // [length²]
    const double here = bench.raw_length("bunny", sigma);
    return bench.denoised("bunny", {implicit_euler, bench.raw_length("bunny", step, 2), iterations, kind, rebuild, {here, here, here}});
}

/// "σ = 0.0011" on the bunny, "σ = 0.236 mean edges" on another mesh.
std::string sigma_text(ClaimBench& bench, double sigma) {
    if (bench.is_itself("bunny")) return "σ = " + plain_text(sigma);
    return "σ = " + readable(sigma / bench.mesh("bunny").entry->mean_edge) + " mean edges";
}

using Curves = std::vector<std::vector<double>>;

/// True if the least error is before the end: an error that still falls has no minimum yet.
bool has_minimum(const std::vector<double>& errors) { return best_of(errors) + 1 < static_cast<int>(errors.size()); }

Curves bunny_curves(ClaimBench& bench) {
    return each_of(bunny_sigmas, [&](double sigma) { return bunny_errors(bench, sigma, 45); });
}

Measurement minima_in_order(ClaimBench& bench, const MeshNames&) {
    const Curves curves = bunny_curves(bench);
    report::Plot plot{.id = "claims_noise", .x_label = "iteration", .y_label = "rms error [% of the box diagonal]"};
    Measurement m{.figure = plot.id};
    Names minima;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        report::Series& series = plot.series.emplace_back(report::Series{.name = sigma_text(bench, bunny_sigmas[i])});
        for (std::size_t t = 0; t < curves[i].size(); ++t)
            add_point(series, double(t), 100 * curves[i][t] / bench.subject("bunny").diagonal);
        const int best = best_of(curves[i]);
        plot.markers.push_back({double(best), series.y[best],
                                words.line(has_minimum(curves[i]) ? "plot.noise.minimum" : "plot.noise.falling", "iteration"_a = best)});
        minima.push_back(std::to_string(best));
        if (i == 0) continue;
        const bool found = has_minimum(curves[i]) && has_minimum(curves[i - 1]);
        m.cases.push_back(
            {series.name + " after " + plot.series[i - 1].name, found ? double(best - best_of(curves[i - 1])) : std::nan("")});
    }
    plot.caption = words.line(bench.is_itself("bunny") ? "plot.noise" : "plot.noise.elsewhere", "minima"_a = listed(minima),
                              "mesh"_a = bench.mesh("bunny").mesh->name);
    bench.plots.push_back(std::move(plot));
    return m;
}

Measurement curves_meet(ClaimBench& bench, const MeshNames&) {
    const Curves curves = bunny_curves(bench);
    const auto larger = [&](std::size_t t) { return 100 * (curves.back()[t] / curves.front()[t] - 1); };
    return {.cases = {{counted(20, "iteration"), larger(20)}, {counted(45, "iteration"), larger(45)}},
            .remark = words.say("claims_s0_curves_meet.remark", "apart"_a = readable(larger(0)))};
}

Measurement minima_of_report(ClaimBench& bench, const MeshNames&) {
    constexpr int iterations = 40;
    Measurement m;
    Names minima;
    for (const bool rebuild : {false, true}) {
        for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::cotan_no_half}) {
            const std::vector<double> low = bunny_errors(bench, 0.0013, iterations, kind, rebuild);
            const std::vector<double> high = bunny_errors(bench, 0.0015, iterations, kind, rebuild);
            const auto off = [](const std::vector<double>& run, double said) { return 100 * std::abs(best_of(run) - said) / said; };
            const bool found = has_minimum(low) && has_minimum(high);
            const std::size_t reached = std::min(low.size(), high.size());
            const std::string variant =
                std::string(kind == OperatorKind::cotan ? "with ½, L " : "without ½, L ") + (rebuild ? "rebuilt" : "kept");
            m.cases.push_back({variant, found ? std::max(off(low, 3), off(high, 7)) : std::nan("")});
            minima.push_back(words.line("claims_s0_minima.remark.variant", "low"_a = best_of(low), "high"_a = best_of(high),
                                        "variant"_a = variant, "collapse"_a = reached <= iterations ? reached : 0));
        }
    }
    m.remark = words.say("claims_s0_minima.remark", "minima"_a = joined(minima, ", "));
    return m;
}

/// A run with noise of this share of the box diagonal, and implicit steps of a tenth of a squared mean edge, of which several are best.
RunKey gentle_run(ClaimBench& bench, std::string_view name, double relative, int iterations) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const double edge = source.preflight().mean_edge, sigma = relative * bounding_box(source.mesh()).diagonal();
    return {.scheme = implicit_euler, .lambda = 0.1 * edge * edge, .iterations = iterations, .sigma = {sigma, sigma, sigma}};
}

TriangleMesh noisy_mesh(ClaimBench& bench, std::string_view name, const RunKey& key) {
    const TriangleMesh& clean = bench.mesh(name).mesh->mesh();
    return moved_to(clean, with_gaussian_noise(clean.X, Vector3(key.sigma.data()), bench.settings().seed));
}

/// rms error on sharp edges over that elsewhere, at the best of 15 iterations; NaN without sharp edges or without other vertices.
Case edges_over_rest(ClaimBench& bench, std::string_view name) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const TriangleMesh& clean = source.mesh();
    RunKey key = gentle_run(bench, name, 0.003, 15);
    key.iterations = best_of(bench.denoised(name, key));
    const Positions X = smooth(noisy_mesh(bench, name, key), {.scheme = key.scheme, .lambda = key.lambda, .iterations = key.iterations}).X;
    const std::vector<char> on_edge = feature_vertices(clean, source.topology());
    const FlaggedMeans squares = flagged_means((X - clean.X).rowwise().squaredNorm(), on_edge);
    return {words.line("claims_s0_flat.case", "mesh"_a = source.name), std::sqrt(squares.there / squares.elsewhere)};
}

const Measure better_where_flat = remarked(edges_over_rest);

std::string level_text(double relative) { return words.line("case.noise", "share"_a = readable_percent(relative)); }

/// rms of the noise that is left over that of the detail that is lost, after the first step that halves the roughness of the clean mesh.
/// The operator of the clean mesh smooths both meshes; it is linear, so their difference is the noise.
Measurement details_go_first(ClaimBench& bench, const MeshNames&) {
    constexpr double little = 0.001, much = 0.03;   // the claim is about nothing less than much; the flow is linear in the noise
    const RunKey key = gentle_run(bench, "cow", much, 1);
    const SmoothingSubject& clean = bench.subject("cow");
    ImplicitSolver solver;
    solver.prepare(operator_with_mass(clean.laplacian), key.lambda / 10);
    Positions shape = clean.mesh().X, both = noisy_mesh(bench, "cow", key).X;
    const double half = roughness(clean, shape) / 2;
    double ratio = undefined;
    for (int step = 0; step < 400 && std::isnan(ratio); ++step) {
        shape = solver.step(shape);
        both = solver.step(both);
        if (roughness(clean, shape) <= half) ratio = vertex_rms(both, shape) / vertex_rms(shape, clean.mesh().X);
    }
    return {.cases = {{level_text(much), ratio}},
            .remark = words.say("claims_s2_too_much.remark", "low"_a = readable_percent(little),
                                "low_ratio"_a = readable(little / much * ratio, 2))};
}

Case gain_at(ClaimBench& bench, double relative) {
    const std::vector<double>& errors = bench.denoised("cow", gentle_run(bench, "cow", relative, 20));
    return {level_text(relative), errors.front() / std::ranges::min(errors)};
}
const Measure low_noise_keeps_features = remarked(at_each({0.001, 0.003}, gain_at));   // more is not little

constexpr double helpful = 1.2;      // of the rms error: less is no help
constexpr int box_iterations = 10;   // S1 took 200 of steps it does not name; ten of larger ones reach as far

/// Tries steps from 0.01 to 100 squared mean edges, with noise of `percent` % of the box in each axis.
Sweep step_sweep(ClaimBench& bench, std::string_view name, double percent) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const double edge = source.preflight().mean_edge;
    const Vector3 sigma = 0.01 * percent * bounding_box(source.mesh()).extent();
    Sweep sweep;
    for (const double multiple : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0}) {
        const std::vector<double>& errors = bench.denoised(name, {.scheme = implicit_euler,
                                                                  .lambda = multiple * edge * edge,
                                                                  .iterations = box_iterations,
                                                                  .sigma = {sigma[0], sigma[1], sigma[2]}});
        sweep.steps.push_back(multiple);
        sweep.errors.push_back(errors.back());
        sweep.noisy = errors.front();
    }
    return sweep;
}

Measurement more_noise_larger_step(ClaimBench& bench, const MeshNames&) {
    const double low = step_sweep(bench, "bunny", 1).best_step(), high = step_sweep(bench, "bunny", 5).best_step();
    return {.cases = {{"5 % noise beside 1 %", high / low}},
            .remark = words.say("claims_s1_larger_step.remark", "low"_a = readable(low, 2), "high"_a = readable(high, 2),
                                "iterations"_a = box_iterations)};
}

Measurement more_noise_worse_result(ClaimBench& bench, const MeshNames&) {
    const Sweep low = step_sweep(bench, "bunny", 1), high = step_sweep(bench, "bunny", 5);
    return {.cases = {{words.line("claims_s1_worse.case.same_step"), high.at(low.best_step()) / low.least()},
                      {words.line("claims_s1_worse.case.best_steps"), high.least() / low.least()}}};
}

Case little_noise(ClaimBench& bench, std::string_view name) {
    const Sweep sweep = step_sweep(bench, name, 1);
    return {bench.mesh(name).mesh->name + ", 1 % noise", sweep.noisy / sweep.least()};
}

/// Measures the gain of the best step; if even that step does not help, nothing is recovered.
Measurement hopeless_noise(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    Names left;
    for (const std::string_view name : meshes) {
        const Sweep sweep = step_sweep(bench, name, 20);
        m.cases.push_back({bench.mesh(name).mesh->name, sweep.noisy / sweep.least()});
        left.push_back(readable(sweep.least() / bench.mesh(name).mesh->preflight().mean_edge));
    }
    m.remark = words.say("claims_s1_hopeless.remark", "left"_a = listed(left));
    return m;
}

/// The errors of several implicit steps with either operator, on the noisy machine part.
struct OperatorSweeps {
    Sweep uniform, cotangent;
    double edge = 0;   // mean [length]
};
OperatorSweeps operator_sweeps(ClaimBench& bench) {
    const double edge = bench.mesh("fandisk_ns").mesh->preflight().mean_edge;
    const std::vector<double> uniform{0.1, 0.2, 0.4, 0.8, 1.6};
    // Δ_uniform ≈ h²/4 Δ: the same diffusion with either operator.
    const std::vector<double> cotangent = each_of(uniform, [&](const double lambda) { return lambda * edge * edge / 4; });
    return {bench.sweep("fandisk_ns", {implicit_euler, 0, 3, OperatorKind::uniform}, uniform),
            bench.sweep("fandisk_ns", {implicit_euler, 0, 3, OperatorKind::cotan}, cotangent), edge};
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

extern const std::vector<Claim> denoising_claims{
    {"claims_s0_minima_order", "q7", {{"bunny"}}, {"minimum_later", "", at_least, 1}, minima_in_order, full},
    {"claims_s0_minima", "q7", {{"bunny"}, {}, itself}, {"deviation", "%", at_most, 34}, minima_of_report, full},
    {"claims_s0_curves_meet", "q7", {{"bunny"}}, {"most_over_least_noise", "%", at_most, 5}, curves_meet, full},
    {"claims_s0_flat", "q7", {{"fandisk", "bunny"}, {flat_with_edges}}, {"edges_over_rest", "", at_least, 1.1}, better_where_flat, full},
    {"claims_s2_low_noise", "q7", {{"cow"}, {not_flat}}, {"gain_of_iteration", "", at_least, 2}, low_noise_keeps_features, full},
    {"claims_s2_too_much", "q7", {{"cow"}, {not_flat}}, {"noise_over_detail", "", at_least, 1}, details_go_first, full},
    {"claims_s1_low_noise", "q7", {{"bunny", "cow"}, {not_flat}}, {"gain_of_step", "", at_least, helpful}, remarked(little_noise), full},
    {"claims_s1_larger_step", "q7", {{"bunny"}, {not_flat}}, {"best_steps", "", at_least, 2}, more_noise_larger_step, full},
    {"claims_s1_worse", "q7", {{"bunny"}, {not_flat}}, {"five_over_one", "", at_least, 1.5}, more_noise_worse_result, full},
    {"claims_s1_hopeless", "q7", {{"bunny", "cow"}, {not_flat}}, {"gain_of_step", "", at_most, helpful}, hopeless_noise, full},
    {"claims_s3_implicit_needed", "q7", {{"fandisk"}}, {"least_explicit", "", at_least, 1.1}, noise_needs_implicit, full},
    {"claims_s3_uniform_larger", "q7", a_fandisk, {"best_uniform", "", at_least, 1.5}, uniform_larger, full},
    {"claims_s3_cotangent_denoises", "q7", a_fandisk, {"least_cotangent", "", at_most, 0.9}, cotangent_better, full}};

}   // namespace meshfolio::claims
