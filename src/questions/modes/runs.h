/// @file
/// Runs of implicit smoothing from many noisy meshes with two operators, and their errors against the clean mesh.
#pragma once

#include "geometry/denoising/noise_level.h"
#include "geometry/denoising/risk_estimate.h"
#include "geometry/smoothing/implicit_solver.h"
#include "questions/bench/smoothing_study.h"

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

/// Solvers kept from run to run, by operator; each thread has its own.
struct FlowSolvers {
    ImplicitSolver clean, own;
};

/// Runs T = `iterations` steps from Y and returns T + 1 positions, or fewer if the operator of Y cannot be factored.
Trajectory denoising_run(const DenoisingFlow& flow, FlowOperator kind, const Positions& Y, int iterations, FlowSolvers& solvers);

/// Squared errors of one run against the clean mesh after t = 0, 1, … T steps.
struct RunErrors {
    Vector vertices;     // mean over the vertices [length²]
    Vector mass;         // mean weighted by the areas of the clean mesh [length²]
    Vector tangential;   // the part of `vertices` along the clean surface [length²]
};
RunErrors errors_of_run(const DenoisingFlow& flow, const Trajectory& run);

/// The errors over all seeds after t = 0, 1, … T steps.
struct MeasuredCurve {
    Vector square, square_error;   // mean squared error and its standard error [length²]
    Vector mass, mass_error;       // the same, weighted by area
    Vector tangential;             // mean of the part along the surface [length²]
    Vector low, high;              // tenth and ninetieth percentile of the rms error [length]
    int seeds = 0;

    int iterations() const { return static_cast<int>(square.size()) - 1; }
    Vector rms() const { return square.cwiseSqrt(); }
    int best() const;   // first iteration with the smallest mean squared error
};
/// Averages the runs. @throws MeshError without a run
MeasuredCurve measured_curve(const std::vector<RunErrors>& runs);

/// Returns the index of the first smallest value.
int first_smallest(const Vector& values);

/// The amount of work, by the settings and the size of the mesh.
struct Extent {
    std::vector<double> levels;   // σ, ascending [box diagonals]
    int iterations;               // at most
    int modes_up_to = all_modes_at_most;
    int seeds = 20, rule_seeds;   // noisy meshes, and those of them that the rules are tried on
    int draws = 4;
};
Extent extent_of(const QuestionSettings& settings, int vertices);

/// Returns the seed of one noisy mesh, draw or probe of a level. Runs count noisy meshes from 0, draws from first_draw, probes from
/// first_probe, so that no two seeds agree.
std::uint64_t seed_of(const QuestionSettings& settings, std::size_t level, int run);
inline constexpr int first_draw = 500, first_probe = 700;

/// The data that all runs of a study share.
struct Work {
    const QuestionSettings& settings;
    const Extent& extent;
    const DenoisingFlow& flow;
    const MeshTopology& topology;
    double difference;   // for derivatives [box diagonals]

    /// Returns the clean mesh with the noise of this seed_of().
    TriangleMesh noisy(double sigma, std::size_t level, int run) const;
};

/// The run from one noisy mesh with one operator.
struct SeedResult {
    RunErrors errors;
    bool collapsed = false;   // the run ended early
    RiskEstimate risk;        // only of runs that rules are tried on
    Vector held_fixed;        // zᵀSᵗz, the divergence as if the operator did not depend on the noise; likewise
};

/// The results of one noise level by operator and seed, and the noise levels estimated from the noisy meshes.
struct LevelResults {
    std::array<std::vector<SeedResult>, 2> of;
    std::vector<NoiseLevel> estimates;
};
/// Runs all seeds of every level, in parallel. @param iterations  of each level
std::vector<LevelResults> results_of_levels(const Work& work, const std::vector<int>& iterations);

}   // namespace meshfolio::modes
