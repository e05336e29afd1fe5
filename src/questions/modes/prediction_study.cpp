#include <numeric>

#include "questions/modes/work.h"

namespace meshfolio::modes {

namespace {

/// Step in squared mean edges: that of question 7, so that its runs are among these.
constexpr double step_in_squared_edges = 0.1;
/// Derivatives of a run are differences over this many mean edges.
constexpr double difference_in_edges = 1e-4;
/// The mesh of the library about the centre of its box, in box diagonals: squares and fourth powers of lengths stay within numbers.
TriangleMesh in_box_diagonals(const TriangleMesh& mesh) {
    const Box box = bounding_box(mesh);
    return moved_to(mesh, (mesh.X.rowwise() - box.centre().transpose()) / box.diagonal());
}

PredictedCurve formula(const DenoisingPrediction& prediction, double sigma, int iterations) {
    const ExpectedError& error = prediction.vertices;
    return {std::string(by_formula), (error.squared(sigma) / error.weight_sum).head(iterations + 1)};
}

/// Takes all modes of a small mesh from the spectrum that the chapters share: in box diagonals d, μ is multiplied by d² and φ by d.
DenoisingPrediction expected_error(const PredictionStudy& study, const LaplaceBeltrami& laplacian, const Positions& X, const Extent& extent,
                                   std::uint64_t seed) {
    PredictionOptions options{study.lambda, extent.iterations, extent.modes_up_to};
    options.seed = seed;
    const int with_mass = operator_with_mass(laplacian).size();
    if (with_mass > extent.modes_up_to || study.preflight().vertices_in_use != with_mass)
        return denoising_prediction(laplacian, X, options);
    const double d = study.diagonal;
    Spectrum spectrum = *all_modes(study);
    spectrum.eigenvalues *= d * d;
    spectrum.eigenvectors *= d;
    return denoising_prediction(laplacian, X, options, spectrum);
}

// ---- rules ---------------------------------------------------------------------------------------------------------------

/// Evaluates one rule over the seeds it can be tried on; `choose(seed)` gives its iteration.
template <class Choose>
RuleOutcome rule_outcome(std::string_view name, const std::vector<SeedResult>& results, int seeds, Choose choose) {
    RuleOutcome outcome{std::string(name), {}, {}};
    for (int s = 0; s < seeds; ++s) {
        const Vector& error = results[s].errors.vertices;
        const int t = choose(s);
        outcome.chosen.push_back(t);
        outcome.regret.push_back(error.minCoeff() > 0 ? std::sqrt(error[t] / error.minCoeff()) - 1 : 0);
    }
    return outcome;
}

void try_rules(OperatorStudy& study, const LevelResults& results, double sigma, int seeds, int numbers) {
    const auto& runs = results.of[int(study.kind)];
    study.rule_seeds = seeds;
    PredictedCurve stein{std::string(by_stein), Vector::Zero(study.measured.square.size())};
    for (int s = 0; s < seeds; ++s) stein.square += runs[s].risk.risk(sigma) * (3.0 / numbers / seeds);
    study.predictions.push_back(std::move(stein));

    const auto add = [&](std::string_view name, auto choose) { study.rules.push_back(rule_outcome(name, runs, seeds, choose)); };
    add(by_stein, [&](std::size_t s) { return runs[s].risk.best(sigma); });
    const auto estimated = [&](std::size_t s) { return results.estimates[s].sigma; };
    const bool known = std::ranges::all_of(results.estimates, [](const NoiseLevel& e) { return e.sigma > 0; });
    if (!known) return;
    add(by_stein_estimated, [&](std::size_t s) { return runs[s].risk.best(estimated(s)); });
    add(by_discrepancy, [&](std::size_t s) { return runs[s].risk.by_discrepancy(estimated(s)); });
    add(by_fixed_operator, [&](std::size_t s) {
        RiskEstimate fixed = runs[s].risk;
        fixed.divergence = runs[s].held_fixed;
        return fixed.best(estimated(s));
    });
}

// ---- assembly --------------------------------------------------------------------------------------------------------------

void enter_estimates(NoiseLevelStudy& level, const std::vector<NoiseLevel>& estimates) {
    for (const NoiseLevel& estimate : estimates) {
        if (!(estimate.sigma > 0)) continue;
        level.sigma_ratio.push_back(estimate.sigma / level.sigma);
    }
}

OperatorStudy operator_study(FlowOperator kind, const LevelResults& results, PredictedCurve predicted) {
    OperatorStudy study;
    study.kind = kind;
    std::vector<RunErrors> errors;
    for (const SeedResult& result : results.of[int(kind)]) {
        errors.push_back(result.errors);
        study.collapsed += result.collapsed ? 1 : 0;
    }
    study.measured = measured_curve(errors);
    const Vector rms = study.measured.rms();
    study.regret_of_formula = rms.minCoeff() > 0 ? rms[predicted.best()] / rms.minCoeff() - 1 : 0;
    study.predictions.push_back(std::move(predicted));
    return study;
}

/// Null without.
template <class Entry>
const Entry* named(const std::vector<Entry>& entries, std::string_view name) {
    const auto it = std::ranges::find(entries, name, &Entry::name);
    return it == entries.end() ? nullptr : &*it;
}

double mean_of(const std::vector<double>& values) {
    return values.empty() ? std::nan("") : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Distance in standard errors. The spread of few runs may be small by chance, so it is at least that of a mean of 3n squared normal
/// numbers, the least variance of any quadratic form of them.
double distance(const ExpectedError& expected, double factor, double sigma, int vertices, const Vector& mean, const Vector& error,
                int seeds, double rounding) {
    double farthest = 0;
    for (Eigen::Index t = 0; t < mean.size(); ++t) {
        const double noise = sigma * sigma / expected.weight_sum;
        const double least = noise * expected.noise[t] * std::sqrt(2.0 / (3.0 * vertices * seeds));
        const double own = noise * expected.noise_error[t];
        const double predicted = expected.bias[t] / expected.weight_sum + factor * factor * noise * expected.noise[t];
        const double spread = std::hypot(std::max(error[t], least), own, rounding * predicted);
        if (spread > 0) farthest = std::max(farthest, std::abs(predicted - mean[t]) / spread);
    }
    return farthest;
}

}   // namespace

double deviation(const Vector& predicted_square, const Vector& measured_square) {
    double farthest = 0;
    for (Eigen::Index t = 0; t < measured_square.size(); ++t)
        if (measured_square[t] > 0)
            farthest = std::max(farthest, std::abs(std::sqrt(std::max(predicted_square[t], 0.0) / measured_square[t]) - 1));
    return farthest;
}

double RuleOutcome::mean_chosen() const { return mean_of(chosen); }
double RuleOutcome::mean_regret() const { return mean_of(regret); }
double RuleOutcome::worst_regret() const { return regret.empty() ? std::nan("") : *std::ranges::max_element(regret); }

const PredictedCurve* OperatorStudy::prediction(std::string_view name) const { return named(predictions, name); }
const RuleOutcome* OperatorStudy::rule(std::string_view name) const { return named(rules, name); }

double NoiseLevelStudy::mean_sigma_ratio() const { return mean_of(sigma_ratio); }

PredictionStudy prediction_study(SharedMesh source, const QuestionSettings& settings) {
    PredictionStudy study;
    study.source = std::move(source);
    const TriangleMesh clean = in_box_diagonals(study.source->mesh());
    const MeshTopology& topology = study.topology();
    const Extent extent = extent_of(settings, clean.vertex_count());
    study.diagonal = bounding_box(study.source->mesh()).diagonal();
    study.mean_edge = mean_edge_length(clean, topology.edges);
    study.lambda = settings.lambda.empty() ? step_in_squared_edges * study.mean_edge * study.mean_edge
                                           : settings.lambda.front() / (study.diagonal * study.diagonal);
    study.seeds = extent.seeds;
    study.draws = extent.draws;

    const DenoisingFlow flow(clean, study.lambda);
    const LaplaceBeltrami laplacian = laplace_beltrami(clean);
    // Bounds the eigenvalues by Gershgorin's theorem.
    const Vector rows = flow.whole.A.cwiseAbs() * Vector::Ones(flow.whole.size());
    study.condition = 1 + study.lambda * rows.cwiseQuotient(flow.whole.M).maxCoeff();
    study.prediction = expected_error(study, laplacian, clean.X, extent, seed_of(settings, 0, first_probe + 200));

    std::vector<int> iterations;   // of each level: four times the expected best one
    for (const double sigma : extent.levels) {
        const int best = study.prediction.vertices.best(sigma);
        iterations.push_back(std::min(extent.iterations, std::max(8, 4 * best + 4)));
    }
    const Work work{settings, extent, flow, topology, difference_in_edges * study.mean_edge};
    const std::vector<LevelResults> results = results_of_levels(work, iterations);

    for (std::size_t l = 0; l < extent.levels.size(); ++l) {
        NoiseLevelStudy level;
        level.sigma = extent.levels[l];
        level.sigma_edges = level.sigma / study.mean_edge;
        enter_estimates(level, results[l].estimates);
        for (const FlowOperator kind : all_operators) {
            level.of(kind) = operator_study(kind, results[l], formula(study.prediction, level.sigma, iterations[l]));
        }
        OperatorStudy& own = level.of(FlowOperator::noisy);
        own.predictions.push_back(formula_of_draws(work, level.sigma, l, iterations[l], level.facts));
        try_rules(own, results[l], level.sigma, extent.rule_seeds, 3 * clean.vertex_count());
        study.levels.push_back(std::move(level));
    }
    return study;
}

StandardDistance standard_distance(const PredictionStudy& study, const NoiseLevelStudy& level, double factor) {
    const MeasuredCurve& measured = level.of(FlowOperator::clean).measured;
    const auto of = [&](const ExpectedError& expected, const Vector& mean, const Vector& error) {
        return distance(expected, factor, level.sigma, study.vertices(), mean, error, measured.seeds, 1e-15 * study.condition);
    };
    return {of(study.prediction.vertices, measured.square, measured.square_error),
            of(study.prediction.mass, measured.mass, measured.mass_error)};
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
            .along_own = own.measured.along[t] / (2 * variance),
            .along_clean = clean.along[t] / (2 * variance),
            .across_own = (measured[t] - own.measured.along[t]) / variance,
            .across_clean = (clean.square[t] - clean.along[t]) / variance};
}

}   // namespace meshfolio::modes
