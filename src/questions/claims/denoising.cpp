// Claims about denoising by diffusion, on meshes whose clean form is known.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"

namespace meshfolio::claims {

namespace {

/// σ of S0's three experiments on the bunny, and its step. [length], [length²]
constexpr std::array bunny_sigmas{0.0011, 0.0013, 0.0015};
constexpr double bunny_step = 5e-7;

NoisyKey bunny_noise(ClaimBench& bench, double sigma, int iterations, OperatorKind kind = OperatorKind::cotan, bool rebuild = false) {
    NoisyKey key;
    key.sigma = Vector3::Constant(bench.raw_length("bunny", sigma));
    // A stand-in gets the same multiple of its squared mean edge: what a step does to noise depends on the edges.
    key.lambda = bench.raw_length("bunny", bunny_step, 2);
    key.iterations = iterations;
    key.laplacian = kind;
    key.rebuild = rebuild;
    return key;
}

/// "σ = 0.0011" on the bunny; what it is brought to on another mesh.
std::string sigma_text(ClaimBench& bench, double sigma) {
    if (bench.is_itself("bunny")) return "σ = " + plain_text(sigma);
    return "σ = " + readable(sigma / bench.mesh("bunny").entry->mean_edge) + " mean edges";
}

report::Plot curves_of(ClaimBench& bench, const std::vector<std::vector<double>>& curves) {
    const double diagonal = bench.subject("bunny").diagonal;
    report::Plot plot{"claims_noise", "", "", "iteration", "rms error [% of the box diagonal]", false, false, {}, {}, {}};
    std::string minima;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        report::Series series{sigma_text(bench, bunny_sigmas[i]), {}, {}};
        for (std::size_t t = 0; t < curves[i].size(); ++t) {
            series.x.push_back(double(t));
            series.y.push_back(100 * curves[i][t] / diagonal);
        }
        const auto best = static_cast<std::size_t>(best_of(curves[i]));
        const bool found = best + 1 < series.y.size();
        plot.markers.push_back(
            {double(best), series.y[best], (found ? "minimum, iteration " : "still falling, iteration ") + std::to_string(best)});
        minima += (i == 0 ? "" : i + 1 == curves.size() ? " and " : ", ") + std::to_string(best);
        plot.series.push_back(std::move(series));
    }
    plot.caption = "Error of the noisy mesh while it is smoothed implicitly, for the three noise levels of S0";
    if (!bench.is_itself("bunny")) plot.caption += ", brought to the mean edge of " + bench.mesh("bunny").mesh->name;
    plot.caption += ": least at iterations " + minima + ".";
    plot.alt = plot.caption;
    return plot;
}

std::vector<std::vector<double>> bunny_curves(ClaimBench& bench) {
    std::vector<std::vector<double>> curves;
    for (const double sigma : bunny_sigmas) curves.push_back(bench.denoised("bunny", bunny_noise(bench, sigma, 45)));
    return curves;
}

Measurement minima_in_order(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const auto curves = bunny_curves(bench);
    for (std::size_t i = 1; i < curves.size(); ++i) {
        const int later = best_of(curves[i]), earlier = best_of(curves[i - 1]);
        const bool found = later + 1 < static_cast<int>(curves[i].size()) && earlier + 1 < static_cast<int>(curves[i - 1].size());
        m.cases.push_back({sigma_text(bench, bunny_sigmas[i]) + " after " + sigma_text(bench, bunny_sigmas[i - 1]),
                           found ? double(later - earlier) : std::nan("")});   // an error that still falls has no minimum yet
    }
    bench.plots.push_back(curves_of(bench, curves));
    m.figure = bench.plots.back().id;
    return m;
}

Measurement curves_meet(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const auto curves = bunny_curves(bench);
    const double first = 100 * (curves.back().front() / curves.front().front() - 1);
    for (const std::size_t t : {20, 45})
        m.cases.push_back({std::to_string(t) + " iterations", 100 * (curves.back()[t] / curves.front()[t] - 1)});
    m.remark = report::text("At the beginning they are ", readable(first), " % apart.");
    return m;
}

Measurement minima_of_report(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    struct Variant {
        OperatorKind kind;
        bool rebuild;
        const char* words;
    };
    report::Text minima = report::text("Minima");
    for (const Variant v :
         {Variant{OperatorKind::cotan, false, "with ½, L kept"}, Variant{OperatorKind::cotan_no_half, false, "without ½, L kept"},
          Variant{OperatorKind::cotan, true, "with ½, L rebuilt"}, Variant{OperatorKind::cotan_no_half, true, "without ½, L rebuilt"}}) {
        const int low = best_of(bench.denoised("bunny", bunny_noise(bench, 0.0013, 40, v.kind, v.rebuild)));
        const int high = best_of(bench.denoised("bunny", bunny_noise(bench, 0.0015, 40, v.kind, v.rebuild)));
        m.cases.push_back({v.words, 100 * std::max(std::abs(low - 3) / 3.0, std::abs(high - 7) / 7.0)});
        report::extend(minima, m.cases.size() == 1 ? " " : ", ", std::to_string(low), " and ", std::to_string(high), " ", v.words);
    }
    report::extend(minima, "; one draw of noise each, and neither the report's generator nor its draw is known.");
    m.remark = minima;
    return m;
}

Measurement better_where_flat(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    for (const std::string_view name : meshes) {
        const DenoisingStudy& study = bench.denoising(name, {0.003}, 15);
        const DenoisingTrial& trial = study.trials.front();
        m.cases.push_back({study.name() + ", best of 15 iterations", trial.feature_rms / trial.smooth_rms});
    }
    m.remark = report::text("Edges are those where two faces meet at more than 40°; noise of 0.3 % of the box diagonal.");
    return m;
}

Measurement details_go_first(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const DenoisingStudy& study = bench.denoising("cow", {0.001, 0.003, 0.03}, 20);
    const DenoisingTrial& much = study.trials.back();   // the claim is about nothing less
    m.cases.push_back({"noise of " + readable_percent(much.relative) + " of the diagonal",
                       much.rms[static_cast<std::size_t>(much.best_rms)] / study.mean_edge});
    m.remark = report::text("A mean edge is the size of the smallest detail that the mesh can show. The best of at most 20 iterations is ",
                            std::to_string(study.trials.back().best_rms), " with most noise, ",
                            std::to_string(study.trials.front().best_rms), " with least.");
    return m;
}

Measurement low_noise_keeps_features(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const DenoisingStudy& study = bench.denoising("cow", {0.001, 0.003, 0.03}, 20);
    for (const DenoisingTrial& trial : study.trials) {
        if (trial.relative > 0.01) continue;   // that is not little
        m.cases.push_back({"noise of " + readable_percent(trial.relative) + " of the diagonal", trial.gain()});
    }
    m.remark = report::text(
        "The less noise there is, the sooner smoothing takes more of the shape than of the noise. To recover is more than to "
        "help, for which a gain of 1.2 would do.");
    return m;
}

}   // namespace

const std::vector<Claim>& denoising_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    static const std::vector<Claim> claims{
        {"claims_s0_minima_order",
         "S0",
         "",
         "q7",
         "With less noise the error reaches its minimum earlier.",
         {{"bunny"}},
         {"how many iterations later the minimum comes with the next more noise", "", at_least, 1},
         Effort::full,
         minima_in_order},
        {"claims_s0_minima",
         "S0",
         "",
         "q7",
         "On the bunny the error is smallest at iteration 3 for σ = 0.0013 and 7 for σ = 0.0015.",
         {{"bunny"}, itself},
         {"the larger relative deviation of the two iterations", "%", at_most, 34},
         Effort::full,
         minima_of_report},
        {"claims_s0_curves_meet",
         "S0",
         "",
         "q7",
         "After more iterations the errors of different noise levels become alike.",
         {{"bunny"}},
         {"how much larger the error with most noise is than that with least", "%", at_most, 5},
         Effort::full,
         curves_meet},
        {"claims_s0_flat",
         "S0",
         "",
         "q7",
         "Denoising does well where the surface is flat, and badly at edges.",
         {{"fandisk", "bunny"}, any_mesh, {Property::flat_with_edges}},
         {"the rms error at edges over that elsewhere", "", at_least, 1.1},
         Effort::full,
         better_where_flat},
        {"claims_s2_low_noise",
         "S2",
         "",
         "q7",
         "With little noise the original is recovered without losing features.",
         {{"cow"}, any_mesh, {Property::not_flat}},
         {"the rms error before over that at the best iteration", "", at_least, 2},
         Effort::full,
         low_noise_keeps_features},
        {"claims_s2_too_much",
         "S2",
         "",
         "q7",
         "With too much noise, details are lost before the noise is.",
         {{"cow"}, any_mesh, {Property::not_flat}},
         {"the rms error left at the best iteration", "mean edges", at_least, 1},
         Effort::full,
         details_go_first},
    };
    return claims;
}

}   // namespace meshfolio::claims
