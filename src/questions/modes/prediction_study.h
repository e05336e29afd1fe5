/// @file
/// The error of denoising: predicted beforehand, measured as the mean of many noisy runs with two operators, and reached by rules that
/// choose the iteration without the clean mesh. All lengths are in box diagonals of the mesh.
#pragma once

#include "geometry/denoising/denoising_prediction.h"
#include "geometry/denoising/noise_level.h"
#include "geometry/denoising/risk_estimate.h"
#include "geometry/smoothing/implicit_solver.h"
#include "questions/bench/smoothing_study.h"
#include "questions/modes/parts.h"

namespace meshfolio::modes {

// ---- runs

/// The mesh that the smoothing operator is made from.
enum class FlowOperator { clean, noisy };

/// Implicit smoothing of meshes with the triangles of `clean`.
struct DenoisingFlow {
    TriangleMesh clean;
    OperatorWithMass whole;   // of the clean mesh
    Positions normals;        // n × 3, of the clean mesh
    double lambda = 0;        // [length²]

    DenoisingFlow(TriangleMesh mesh, double step);
};

/// Solvers kept from run to run, by FlowOperator; each thread has its own.
using FlowSolvers = std::array<ImplicitSolver, 2>;

/// Runs T = `iterations` implicit steps from Y by the operator of flow.clean or of Y, and returns T + 1 positions, Y first; fewer if the
/// operator cannot be factored.
Trajectory denoising_run(const DenoisingFlow& flow, FlowOperator kind, const Positions& Y, int iterations, FlowSolvers& solvers);

/// Squared errors of one run against the clean mesh after t = 0, 1, … T steps.
struct RunErrors {
    Vector vertices;     // mean over the vertices [length²]
    Vector mass;         // mean weighted by the areas of the clean mesh [length²]
    Vector tangential;   // the part of `vertices` along the clean surface [length²]
};
/// Computes the squared errors of a run against flow.clean, an entry for each of its positions.
RunErrors errors_of_run(const DenoisingFlow& flow, const Trajectory& run);

/// Returns the index of the first smallest value.
inline int first_smallest(const Vector& values) { return static_cast<int>(std::ranges::min_element(values) - values.begin()); }

/// The errors over all seeds after t = 0, 1, … T steps.
struct MeasuredCurve {
    Vector square, square_error;   // mean squared error and its standard error [length²]
    Vector mass, mass_error;       // mean squared error weighted by area, and its standard error [length²]
    Vector tangential;             // mean of the part along the surface [length²]
    Vector low, high;              // tenth and ninetieth percentile of the rms error [length]
    int seeds = 0;

    int iterations() const { return static_cast<int>(square.size()) - 1; }
    Vector rms() const { return square.cwiseSqrt(); }
    int best() const { return first_smallest(square); }   // iteration with the smallest mean squared error
};
/// Averages the runs, which have equal length. @throws MeshError without a run
MeasuredCurve measured_curve(const std::vector<RunErrors>& runs);

/// The amount of work, by the settings and the size of the mesh.
struct Extent {
    std::vector<double> levels;   // σ, ascending [box diagonals]
    int iterations;               // at most
    int modes_up_to = all_modes_at_most;
    int seeds = 20, rule_seeds;   // noisy meshes, and those of them that the rules are tried on
    int draws = 4;
};
/// Returns the levels of the settings, else 0.003 and 0.01 (quick: 0.01; laboratory: 0.001, 0.003, 0.01, 0.03), and the iterations: the
/// last of the settings, else 40 (quick: 10, laboratory: 80), at most 600,000/vertices but not below 8.
Extent extent_of(const QuestionSettings& settings, int vertices);

/// Returns settings.seed + 1000 (level + 1) + run, the seed of one noisy mesh, draw or probe of a level. Runs count noisy meshes from 0,
/// draws from first_draw, probes from first_probe, so that no two seeds agree.
std::uint64_t seed_of(const QuestionSettings& settings, std::size_t level, int run);
inline constexpr int first_draw = 500, first_probe = 700;

/// The data that all runs of a study share.
struct Work {
    const QuestionSettings& settings;
    const Extent& extent;
    const DenoisingFlow& flow;
    const MeshTopology& topology;
    double difference;   // for derivatives [box diagonals]

    /// Returns the clean mesh with Gaussian noise of this σ [box diagonals] and seed_of(settings, level, run).
    TriangleMesh noisy(double sigma, std::size_t level, int run) const;
};

/// The run from one noisy mesh with one operator.
struct SeedResult {
    RunErrors errors;
    bool collapsed = false;   // the run ended early
    RiskEstimate risk;        // only of runs that rules are tried on
    Vector held_fixed;        // zᵀSᵗz, the divergence as if the operator did not depend on the noise; only with `risk`
};

/// The results of one noise level by operator and seed, and the noise levels estimated from the noisy meshes.
struct LevelResults {
    std::array<std::vector<SeedResult>, 2> of;
    std::vector<NoiseLevel> estimates;
};
/// Runs all seeds of every level by both operators, in parallel. @param iterations  of each level @return the levels in order
std::vector<LevelResults> results_of_levels(const Work& work, const std::vector<int>& iterations);

// ---- predictions and rules

/// A prediction of the mean squared error over the vertices for t = 0, 1, … T.
struct PredictedCurve {
    std::string name;
    Vector square;

    int best() const { return first_smallest(square); }
};
/// Returns the largest |predicted/measured − 1| of the rms error over the iterations, from squared errors; skips measured errors of 0.
double deviation(const Vector& predicted_square, const Vector& measured_square);
inline double deviation(const PredictedCurve& predicted, const MeasuredCurve& measured) {
    return deviation(predicted.square, measured.square);
}

/// The choices of a rule over the seeds. The regret is the rms error at the chosen iteration over the smallest of that run, less 1.
struct RuleOutcome {
    std::string name;
    double mean_chosen = 0;   // iteration
    double mean_regret = 0, worst_regret = 0;
};

/// One operator at one noise level.
struct OperatorStudy {
    MeasuredCurve measured;
    std::vector<PredictedCurve> predictions;   // first the formula with the clean mesh's operator
    std::vector<RuleOutcome> rules;            // none for the clean mesh's operator
    int rule_seeds = 0;
    int collapsed = 0;              // runs that ended early, because triangles collapsed
    double regret_of_formula = 0;   // of the measured mean curve at the formula's best iteration

    const PredictedCurve& formula() const { return predictions.front(); }
    bool minimum_reached() const { return measured.best() < measured.iterations(); }
    const PredictedCurve* prediction(std::string_view name) const;   // null if there is none
    const RuleOutcome* rule(std::string_view name) const;            // null if there is none
};

/// The change that noise makes to the operator of the mesh, mean over the draws.
struct OperatorFacts {
    double area = 1;               // of the noisy mesh over that of the clean one
    double negative_weights = 0;   // share of the edges
};

struct NoiseLevelStudy {
    double sigma = 0;   // [box diagonals]
    std::array<OperatorStudy, 2> operators;
    OperatorFacts facts;
    double sigma_ratio = undefined;   // mean σ̂/σ over the seeds that the rules were tried on; NaN if no patch could be fitted

    const OperatorStudy& of(FlowOperator kind) const { return operators[int(kind)]; }
};

struct PredictionStudy : OnMesh {
    double diagonal = 0;        // of the bounding box [length of the model]
    double mean_edge = 0;       // [box diagonals]
    double lambda = 0;          // [squared box diagonals]
    int seeds = 0, draws = 0;   // noisy meshes measured, and other ones with operators that predict
    double condition = 1;       // bound for the clean mesh's M − λC relative to M, which multiplies rounding
    DenoisingPrediction prediction;
    std::vector<NoiseLevelStudy> levels;   // ascending σ
};
/// Predicts and measures the errors for every level of extent_of(), by λ = 0.1 squared mean edges or the first λ of the settings.
PredictionStudy prediction_study(SharedMesh source, const QuestionSettings& settings);

/// Distances in standard errors, of the mean over the vertices and of the mean weighted by area.
struct StandardDistance {
    double vertices = 0, mass = 0;
    double larger() const { return std::max(vertices, mass); }
};
/// Returns the largest distance between formula and measured mean with the clean operator, in standard errors including rounding.
/// @param factor  multiplies σ in the formula, for a control that must fail
StandardDistance standard_distance(const PredictionStudy& study, const NoiseLevelStudy& level, double factor = 1);
/// Returns the largest |expected/measured − 1| of the area-weighted rms error over the iterations, with the clean operator.
double largest_mass_deviation(const PredictionStudy& study, const NoiseLevelStudy& level);

/// The parts of the measured error at the iteration where the formula is farthest from it: mean squared errors over that of the noise, 3σ².
struct ErrorAccount {
    int iteration = 0;
    double formula = 0;     // with the clean mesh's operator
    double numbers = 0;     // more, because the operator has the numbers of another noisy mesh
    double knowledge = 0;   // more, because it is made from the same noise that it smooths
    double measured = 0;    // the sum of the three
    /// Squared error along the clean surface over that of the noise, 2σ², and across it over σ².
    double along_own = 0, along_clean = 0, across_own = 0, across_clean = 0;
};
/// Computes the parts of the error with the noisy mesh's own operator at one level.
ErrorAccount error_account(const NoiseLevelStudy& level);

// Names of predictions and rules.
inline constexpr std::string_view by_formula = "formula, clean operator", by_draws = "formula, operators of other draws",
                                  by_stein = "Stein, σ known", by_stein_estimated = "Stein, σ̂", by_fixed_operator = "Stein, σ̂, held fixed",
                                  by_discrepancy = "discrepancy, σ̂";

/// Lists every level of every mesh as `part`, with its study as `whole`.
inline auto levels_of(const PredictionStudies& studies) { return parts_within(studies, &PredictionStudy::levels); }

}   // namespace meshfolio::modes
