/// @file
/// The error of denoising expected beforehand, the mean of many noisy runs with two operators, and rules that choose the iteration without
/// the clean mesh.
#pragma once

#include "geometry/denoising/denoising_prediction.h"
#include "geometry/denoising/risk_estimate.h"
#include "questions/core/section_tools.h"

namespace meshfolio::modes {

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

/// Solvers kept from run to run; each thread has its own.
struct FlowSolvers {
    ImplicitSolver clean, own;
};

/// Runs T steps from Y and returns T + 1 positions; fewer where the operator of Y cannot be factored.
Trajectory denoising_run(const DenoisingFlow& flow, FlowOperator kind, const Positions& Y, int iterations, FlowSolvers& solvers);
/// Extends a run that ended early by its last positions.
Trajectory kept_at_its_end(Trajectory run, int iterations);

/// Squared errors of one run against the clean mesh after t = 0, 1, … T steps.
struct RunErrors {
    Vector vertices;   // mean over the vertices [length²]
    Vector mass;       // mean with the areas of the clean mesh as weights [length²]
    Vector along;      // of `vertices`, the part along the clean surface [length²]
};
RunErrors errors_of_run(const DenoisingFlow& flow, const Trajectory& run);

/// The errors over all seeds after t = 0, 1, … T steps.
struct MeasuredCurve {
    Vector square, square_error;   // mean squared error and its standard error [length²]
    Vector mass, mass_error;       // the same, weighted by area
    Vector along;                  // mean of the part along the surface
    Vector low, high;              // tenth and ninetieth percentile of the rms error [length]
    int seeds = 0;

    int iterations() const { return static_cast<int>(square.size()) - 1; }
    Vector rms() const { return square.cwiseSqrt(); }
    int best() const;   // first iteration with the smallest mean squared error
};
/// The mean, in order of the seeds. @throws MeshError without a run
MeasuredCurve measured_curve(const std::vector<RunErrors>& runs);

int first_smallest(const Vector& values);

/// A mean squared error over the vertices foreseen for t = 0, 1, … T. All lengths of a study are in box diagonals of its mesh.
struct PredictedCurve {
    std::string name;
    Vector square;

    int best() const { return first_smallest(square); }
};
/// Largest |predicted/measured − 1| of the rms error over the iterations.
double deviation(const Vector& predicted_square, const Vector& measured_square);
inline double deviation(const PredictedCurve& predicted, const MeasuredCurve& measured) {
    return deviation(predicted.square, measured.square);
}

/// What a rule chose, one value a seed it was tried on.
struct RuleOutcome {
    std::string name;
    std::vector<double> chosen;   // iteration
    std::vector<double> regret;   // error there over the smallest of that run, less 1

    double mean_chosen() const;
    double mean_regret() const;
    double worst_regret() const;
};

/// One operator at one noise level.
struct OperatorStudy {
    FlowOperator kind = FlowOperator::clean;
    MeasuredCurve measured;
    std::vector<PredictedCurve> predictions;   // the formula with the clean mesh's operator first
    std::vector<RuleOutcome> rules;            // none for the clean mesh's operator: who has it needs no rule
    int rule_seeds = 0;
    int collapsed = 0;              // runs that ended early, because triangles collapsed
    double regret_of_formula = 0;   // of the measured mean curve at the formula's best iteration

    const PredictedCurve& formula() const { return predictions.front(); }
    bool minimum_reached() const { return measured.best() < measured.iterations(); }
    const PredictedCurve* prediction(std::string_view name) const;   // null without
    const RuleOutcome* rule(std::string_view name) const;            // null without
};

/// What the noise does to the operator of the mesh, mean over the draws. The clean mesh's is that of the study.
struct OperatorFacts {
    double area = 1;               // of the noisy mesh over that of the clean one
    double negative_weights = 0;   // share of the edges
};

struct NoiseLevelStudy {
    double sigma = 0;         // [box diagonals]
    double sigma_edges = 0;   // [mean edges]
    std::array<OperatorStudy, 2> operators;
    OperatorFacts facts;
    std::vector<double> sigma_ratio;   // σ̂/σ, one a seed the rules were tried on; empty where no patch could be fitted

    const OperatorStudy& of(FlowOperator kind) const { return operators[int(kind)]; }
    OperatorStudy& of(FlowOperator kind) { return operators[int(kind)]; }
    double mean_sigma_ratio() const;
};

struct PredictionStudy : OnMesh {
    double diagonal = 0;        // of the bounding box [length of the model]
    double mean_edge = 0;       // [box diagonals]
    double lambda = 0;          // [squared box diagonals]
    int seeds = 0, draws = 0;   // noisy meshes measured; and others whose operators predict
    double condition = 1;       // of the clean mesh's M − λC beside M, at most: rounding is multiplied by it
    DenoisingPrediction prediction;
    std::vector<NoiseLevelStudy> levels;   // ascending σ

    int vertices() const { return source->mesh().vertex_count(); }
};
PredictionStudy prediction_study(SharedMesh source, const QuestionSettings& settings);

/// Largest distance between formula and measured mean with the clean operator, in standard errors including rounding.
/// @param factor  multiplies σ in the formula: a wrong one must be seen
struct StandardDistance {
    double vertices = 0, mass = 0;
    double larger() const { return std::max(vertices, mass); }
};
StandardDistance standard_distance(const PredictionStudy& study, const NoiseLevelStudy& level, double factor = 1);
/// Largest relative deviation of the expected from the measured area-weighted error, clean operator, over all iterations.
double largest_mass_deviation(const PredictionStudy& study, const NoiseLevelStudy& level);

/// Explains where the formula is farthest from the measurement: mean squared errors over that of the noise, 3σ².
struct ErrorAccount {
    int iteration = 0;
    double formula = 0;     // with the clean mesh's operator
    double numbers = 0;     // more, because the operator has other numbers: those of other noisy meshes
    double knowledge = 0;   // more, because it is made from the same noise that it smooths
    double measured = 0;    // the sum of the three
    /// Squared error along the clean surface over that of the noise, 2σ², and across it over σ².
    double along_own = 0, along_clean = 0, across_own = 0, across_clean = 0;
};
ErrorAccount error_account(const NoiseLevelStudy& level);

/// Names of predictions and rules.
inline constexpr std::string_view by_formula = "formula, clean operator", by_draws = "formula, operators of other draws",
                                  by_stein = "Stein, σ known", by_stein_estimated = "Stein, σ̂", by_fixed_operator = "Stein, σ̂, held fixed",
                                  by_discrepancy = "discrepancy, σ̂";

using PredictionStudies = std::vector<PredictionStudy>;

/// Every level of every mesh: its study as `whole`, itself as `part`.
inline auto levels_of(const PredictionStudies& studies) { return parts_within(studies, &PredictionStudy::levels); }

}   // namespace meshfolio::modes
