#include "questions/modes/work.h"

#include "base/parallel_tasks.h"
#include "mesh/vertex_noise.h"

namespace meshfolio::modes {

namespace {

/// Threads' worth of runs, each with solvers of its own; fixed, so that nothing depends on the machine.
constexpr int chains = 4;

/// zᵀSᵗz with the operator that the last run with its own operator has left in the solver.
Vector fixed_divergence(const Positions& direction, int iterations, FlowSolvers& solvers) {
    Vector divergence(iterations + 1);
    Positions Z = direction;
    for (int t = 0; t <= iterations; ++t) {
        if (t > 0) Z = solvers.own.step(Z);
        divergence[t] = direction.cwiseProduct(Z).sum();
    }
    return divergence;
}

SeedResult seed_result(const Work& work, FlowOperator kind, const Positions& Y, int iterations, std::uint64_t probe_seed, bool with_rule,
                       FlowSolvers& solvers) {
    SeedResult result;
    Trajectory moved;
    const Positions direction = with_rule ? random_signs(Y.rows(), probe_seed) : Positions();
    if (with_rule)
        moved = kept_at_its_end(denoising_run(work.flow, kind, Y + work.difference * direction, iterations, solvers), iterations);
    Trajectory run = denoising_run(work.flow, kind, Y, iterations, solvers);
    result.collapsed = static_cast<int>(run.size()) <= iterations;
    run = kept_at_its_end(std::move(run), iterations);
    result.errors = errors_of_run(work.flow, run);
    if (!with_rule) return result;
    result.risk = risk_estimate(run, moved, direction, work.difference);
    result.held_fixed = fixed_divergence(direction, iterations, solvers);
    return result;
}

void run_seed(const Work& work, LevelResults& results, double sigma, std::size_t level, int seed, FlowSolvers& solvers) {
    const TriangleMesh noisy = work.noisy(sigma, level, seed);
    const bool with_rule = seed < work.extent.rule_seeds;
    if (with_rule) results.estimates[seed] = noise_level(noisy, work.topology);
    for (const FlowOperator kind : all_operators)
        results.of[int(kind)][seed] =
            seed_result(work, kind, noisy.X, results.iterations, seed_of(work.settings, level, first_probe + seed),
                        with_rule && kind == FlowOperator::noisy, solvers);
}

}   // namespace

Extent extent_of(const QuestionSettings& settings, int vertices) {
    Extent extent;
    extent.levels = settings.noise;
    if (extent.levels.empty() && settings.laboratory) extent.levels = {0.001, 0.003, 0.01, 0.03};
    if (extent.levels.empty()) extent.levels = settings.quick ? std::vector{0.01} : std::vector{0.003, 0.01};
    extent.levels = each_once(extent.levels);
    const int most = last_or(settings.iterations, settings.laboratory ? 80 : settings.quick ? 10 : 40);
    extent.iterations = std::clamp(600'000 / vertices, std::min(8, most), most);
    extent.rule_seeds = settings.quick ? 4 : vertices > 3000 ? 8 : 20;
    if (settings.quick) extent.modes_up_to = 300;   // beyond, all modes take longer than all the rest
    return extent;
}

std::uint64_t seed_of(const QuestionSettings& settings, std::size_t level, int run) {
    return settings.seed + 1000 * (level + 1) + static_cast<std::uint64_t>(run);
}

TriangleMesh Work::noisy(double sigma, std::size_t level, int run) const {
    return moved_to(flow.clean, with_gaussian_noise(flow.clean.X, Vector3::Constant(sigma), seed_of(settings, level, run)));
}

std::vector<LevelResults> results_of_levels(const Work& work, const std::vector<int>& iterations) {
    std::vector<LevelResults> levels(iterations.size());
    for (std::size_t l = 0; l < levels.size(); ++l) {
        for (auto& results : levels[l].of) results.resize(work.extent.seeds);
        levels[l].iterations = iterations[l];
        levels[l].estimates.resize(work.extent.rule_seeds);
    }
    for_each_task(chains, [&](std::size_t chain) {
        FlowSolvers solvers;
        for (std::size_t l = 0; l < levels.size(); ++l)
            for (int seed = static_cast<int>(chain); seed < work.extent.seeds; seed += chains)
                run_seed(work, levels[l], work.extent.levels[l], l, seed, solvers);
    });
    return levels;
}

OperatorFacts facts_of(const LaplaceBeltrami& laplacian, double clean_area) {
    int negative = 0, all = 0;
    for (int j = 0; j < laplacian.C.outerSize(); ++j) {
        for (SparseMatrix::InnerIterator entry(laplacian.C, j); entry; ++entry) {
            if (entry.row() >= j) continue;
            ++all;
            negative += entry.value() < 0 ? 1 : 0;
        }
    }
    return {laplacian.M.sum() / clean_area, all > 0 ? static_cast<double>(negative) / all : 0};
}

PredictedCurve formula_of_draws(const Work& work, double sigma, std::size_t level, int iterations, OperatorFacts& facts) {
    const auto draws = static_cast<std::size_t>(work.extent.draws);
    std::vector<Vector> squares(draws);
    std::vector<OperatorFacts> drawn(draws);
    for_each_task(draws, [&](std::size_t d) {
        const LaplaceBeltrami laplacian = laplace_beltrami(work.noisy(sigma, level, first_draw + static_cast<int>(d)));
        PredictionOptions options{work.flow.lambda, iterations};
        options.modes_up_to = 0;
        options.probe_triples = 2;
        options.seed = seed_of(work.settings, level, first_probe + work.extent.seeds + static_cast<int>(2 * d));
        const ExpectedError error = denoising_prediction(laplacian, work.flow.clean.X, options).vertices;
        squares[d] = error.squared(sigma) / error.weight_sum;
        drawn[d] = facts_of(laplacian, work.flow.whole.M.sum());
    });
    PredictedCurve mean{std::string(by_draws), Vector::Zero(iterations + 1)};
    facts = {0, 0};
    for (std::size_t d = 0; d < draws; ++d) {
        mean.square += squares[d] / static_cast<double>(draws);
        facts.area += drawn[d].area / static_cast<double>(draws);
        facts.negative_weights += drawn[d].negative_weights / static_cast<double>(draws);
    }
    return mean;
}

}   // namespace meshfolio::modes
