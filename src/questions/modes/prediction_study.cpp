#include "questions/modes/prediction_study.h"

#include "base/parallel_tasks.h"
#include "questions/bench/bench_mesh.h"

namespace meshfolio::modes {

namespace {

constexpr double step_in_squared_edges = 0.1;   // that of question 7, so that its runs are among these
constexpr double difference_in_edges = 1e-4;    // between two runs for a derivative

/// Predicts the errors. All modes of a small mesh come from the spectrum that the chapters share: in box diagonals d, μ is multiplied by d²
/// and φ by d.
DenoisingPrediction expected_error(const PredictionStudy& study, const LaplaceBeltrami& laplacian, const Positions& X, const Extent& extent,
                                   std::uint64_t seed) {
    PredictionOptions options{study.lambda, extent.iterations, extent.modes_up_to};
    options.seed = seed;
    const int with_mass = operator_with_mass(laplacian).size();
    if (with_mass > extent.modes_up_to || study.preflight().vertices_in_use != with_mass)
        return denoising_prediction(laplacian, X, options);
    const double d = study.diagonal;
    Spectrum spectrum = all_modes(study);
    spectrum.eigenvalues *= d * d;
    spectrum.eigenvectors *= d;
    return denoising_prediction(laplacian, X, options, spectrum);
}

/// Predicts the error as the mean over operators of other noisy meshes: such an operator has noise, but not the noise that it smooths.
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
        const NegativeWeights negative = negative_weights(laplacian.C, work.topology);
        drawn[d] = {laplacian.M.sum() / work.flow.whole.M.sum(),
                    double(negative.inside + negative.boundary) / static_cast<double>(work.topology.edges.size())};
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

/// Tries the rules on the runs with the operator of the noisy mesh, and adds the mean of Stein's estimates to the predictions.
void try_rules(OperatorStudy& study, const LevelResults& results, double sigma) {
    const auto& runs = results.of[int(FlowOperator::noisy)];
    const std::size_t seeds = results.estimates.size();
    study.rule_seeds = static_cast<int>(seeds);
    PredictedCurve stein{std::string(by_stein), Vector::Zero(study.measured.square.size())};
    for (std::size_t s = 0; s < seeds; ++s) stein.square += runs[s].risk.risk(sigma) * (3.0 / runs[s].risk.numbers / double(seeds));
    study.predictions.push_back(std::move(stein));

    const auto add = [&](std::string_view name, const auto& choose) {
        RuleOutcome& outcome = study.rules.emplace_back(RuleOutcome{std::string(name)});
        for (std::size_t s = 0; s < seeds; ++s) {
            const Vector& error = runs[s].errors.vertices;
            const int t = choose(runs[s], results.estimates[s].sigma);
            const double regret = error.minCoeff() > 0 ? std::sqrt(error[t] / error.minCoeff()) - 1 : 0;
            outcome.mean_chosen += t;
            outcome.mean_regret += regret;
            outcome.worst_regret = std::max(outcome.worst_regret, regret);
        }
        outcome.mean_chosen /= static_cast<double>(seeds);
        outcome.mean_regret /= static_cast<double>(seeds);
    };
    add(by_stein, [&](const SeedResult& run, double) { return run.risk.best(sigma); });
    if (!std::ranges::all_of(results.estimates, [](const NoiseLevel& e) { return e.sigma > 0; })) return;
    add(by_stein_estimated, [](const SeedResult& run, double estimate) { return run.risk.best(estimate); });
    add(by_discrepancy, [](const SeedResult& run, double estimate) { return run.risk.by_discrepancy(estimate); });
    add(by_fixed_operator, [](const SeedResult& run, double estimate) {
        RiskEstimate fixed = run.risk;
        fixed.divergence = run.held_fixed;
        return fixed.best(estimate);
    });
}

NoiseLevelStudy level_study(const PredictionStudy& study, const Work& work, const LevelResults& results, std::size_t l, int iterations) {
    NoiseLevelStudy level;
    level.sigma = work.extent.levels[l];
    double ratios = 0;
    int fitted = 0;
    for (const NoiseLevel& estimate : results.estimates)
        if (estimate.sigma > 0) ratios += estimate.sigma / level.sigma, ++fitted;
    if (fitted > 0) level.sigma_ratio = ratios / fitted;
    const ExpectedError& error = study.prediction.vertices;
    const PredictedCurve formula{std::string(by_formula), (error.squared(level.sigma) / error.weight_sum).head(iterations + 1)};
    for (std::size_t kind = 0; kind < level.operators.size(); ++kind) {
        OperatorStudy& operated = level.operators[kind];
        operated.measured = measured_curve(each_of(results.of[kind], &SeedResult::errors));
        operated.collapsed = static_cast<int>(std::ranges::count(results.of[kind], true, &SeedResult::collapsed));
        const Vector rms = operated.measured.rms();
        operated.regret_of_formula = rms.minCoeff() > 0 ? rms[formula.best()] / rms.minCoeff() - 1 : 0;
        operated.predictions.push_back(formula);
    }
    OperatorStudy& own = level.operators[int(FlowOperator::noisy)];
    own.predictions.push_back(formula_of_draws(work, level.sigma, l, iterations, level.facts));
    try_rules(own, results, level.sigma);
    return level;
}

/// Returns the entry of this name; null if there is none.
template <class Entry> const Entry* named(const std::vector<Entry>& entries, std::string_view name) {
    const auto it = std::ranges::find(entries, name, &Entry::name);
    return it == entries.end() ? nullptr : &*it;
}

}   // namespace

double deviation(const Vector& predicted_square, const Vector& measured_square) {
    double farthest = 0;
    for (Eigen::Index t = 0; t < measured_square.size(); ++t)
        if (measured_square[t] > 0)
            farthest = std::max(farthest, std::abs(std::sqrt(std::max(predicted_square[t], 0.0) / measured_square[t]) - 1));
    return farthest;
}

const PredictedCurve* OperatorStudy::prediction(std::string_view name) const { return named(predictions, name); }
const RuleOutcome* OperatorStudy::rule(std::string_view name) const { return named(rules, name); }

PredictionStudy prediction_study(SharedMesh source, const QuestionSettings& settings) {
    PredictionStudy study;
    study.source = std::move(source);
    const Box box = bounding_box(study.mesh());
    study.diagonal = box.diagonal();
    // In box diagonals about the centre, squares and fourth powers of lengths neither overflow nor vanish.
    const TriangleMesh clean = moved_to(study.mesh(), (study.mesh().X.rowwise() - box.centre().transpose()) / study.diagonal);
    const MeshTopology& topology = study.topology();
    const Extent extent = extent_of(settings, clean.vertex_count());
    study.mean_edge = mean_edge_length(clean, topology.edges);
    study.lambda = settings.lambda.empty() ? step_in_squared_edges * study.mean_edge * study.mean_edge
                                           : settings.lambda.front() / (study.diagonal * study.diagonal);
    study.seeds = extent.seeds;
    study.draws = extent.draws;

    const DenoisingFlow flow(clean, study.lambda);
    const Vector rows = flow.whole.A.cwiseAbs() * Vector::Ones(flow.whole.size());   // Gershgorin's bound of the eigenvalues
    study.condition = 1 + study.lambda * rows.cwiseQuotient(flow.whole.M).maxCoeff();
    study.prediction = expected_error(study, laplace_beltrami(clean), clean.X, extent, seed_of(settings, 0, first_probe + 200));

    const std::vector<int> iterations = each_of(extent.levels, [&](double sigma) {
        return std::min(extent.iterations, std::max(8, 4 * study.prediction.vertices.best(sigma) + 4));
    });
    const Work work{settings, extent, flow, topology, difference_in_edges * study.mean_edge};
    const std::vector<LevelResults> results = results_of_levels(work, iterations);
    for (std::size_t l = 0; l < results.size(); ++l) study.levels.push_back(level_study(study, work, results[l], l, iterations[l]));
    return study;
}

StandardDistance standard_distance(const PredictionStudy& study, const NoiseLevelStudy& level, double factor) {
    const MeasuredCurve& measured = level.of(FlowOperator::clean).measured;
    const double rounding = 1e-15 * study.condition;
    const auto largest = [&](const ExpectedError& expected, const Vector& mean, const Vector& error) {
        double farthest = 0;
        for (Eigen::Index t = 0; t < mean.size(); ++t) {
            const double noise = level.sigma * level.sigma / expected.weight_sum;
            // The spread of few runs may be small by chance, so it is at least that of a mean of 3n squared normal numbers, the least
            // variance of any quadratic form of them.
            const double least = noise * expected.noise[t] * std::sqrt(2.0 / (3.0 * study.mesh().vertex_count() * measured.seeds));
            const double own = noise * expected.noise_error[t];
            const double predicted = expected.bias[t] / expected.weight_sum + factor * factor * noise * expected.noise[t];
            const double spread = std::hypot(std::max(error[t], least), own, rounding * predicted);
            if (spread > 0) farthest = std::max(farthest, std::abs(predicted - mean[t]) / spread);
        }
        return farthest;
    };
    return {largest(study.prediction.vertices, measured.square, measured.square_error),
            largest(study.prediction.mass, measured.mass, measured.mass_error)};
}

double largest_mass_deviation(const PredictionStudy& study, const NoiseLevelStudy& level) {
    const ExpectedError& expected = study.prediction.mass;
    return deviation(expected.squared(level.sigma) / expected.weight_sum, level.of(FlowOperator::clean).measured.mass);
}

ErrorAccount error_account(const NoiseLevelStudy& level) {
    const OperatorStudy& own = level.of(FlowOperator::noisy);
    const MeasuredCurve& clean = level.of(FlowOperator::clean).measured;
    const Vector &measured = own.measured.square, &formula = own.formula().square, &draws = own.prediction(by_draws)->square;
    Eigen::Index t = 0;
    (formula.cwiseQuotient(measured).array().log().abs()).maxCoeff(&t);
    const double noise = 3 * level.sigma * level.sigma, variance = level.sigma * level.sigma;
    return {.iteration = static_cast<int>(t),
            .formula = formula[t] / noise,
            .numbers = (draws[t] - formula[t]) / noise,
            .knowledge = (measured[t] - draws[t]) / noise,
            .measured = measured[t] / noise,
            .along_own = own.measured.tangential[t] / (2 * variance),
            .along_clean = clean.tangential[t] / (2 * variance),
            .across_own = (measured[t] - own.measured.tangential[t]) / variance,
            .across_clean = (clean.square[t] - clean.tangential[t]) / variance};
}

std::shared_ptr<const PredictionStudies> prediction_studies(const LibraryMeshes& meshes, const QuestionSettings& settings,
                                                            const Progress& progress, report::Section& section) {
    return std::make_shared<PredictionStudies>(studies_of(meshes, "predicted denoising", settings, progress, section, prediction_study));
}

}   // namespace meshfolio::modes
