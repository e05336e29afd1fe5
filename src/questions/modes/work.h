/// @file
/// The runs and the predictions that a study of predicted denoising is made of. Private to the layer.
#pragma once

#include "geometry/denoising/noise_level.h"
#include "mesh/mesh_topology.h"
#include "questions/bench/smoothing_study.h"
#include "questions/modes/prediction_study.h"

namespace meshfolio::modes {

inline constexpr std::array all_operators{FlowOperator::clean, FlowOperator::noisy};

/// How much is done, by the settings and the size of the mesh.
struct Extent {
    std::vector<double> levels;   // σ [box diagonals]
    int iterations;               // at most
    int modes_up_to = all_modes_at_most;
    int seeds = 20, rule_seeds;
    int draws = 4;
};

Extent extent_of(const QuestionSettings& settings, int vertices);

/// Seeds of the noisy meshes, of the draws that predict, and of the probes never meet.
std::uint64_t seed_of(const QuestionSettings& settings, std::size_t level, int run);
inline constexpr int first_draw = 500, first_probe = 700;   // runs

/// Everything the parts of one study share.
struct Work {
    const QuestionSettings& settings;
    const Extent& extent;
    const DenoisingFlow& flow;
    const MeshTopology& topology;
    double difference;   // for derivatives [box diagonals]

    TriangleMesh noisy(double sigma, std::size_t level, int run) const;
};

/// What one noisy mesh gives with one operator.
struct SeedResult {
    RunErrors errors;
    bool collapsed = false;   // the run ended early
    RiskEstimate risk;        // where rules are tried
    Vector held_fixed;        // zᵀSᵗz with the operator of the noisy mesh as if it were given
};

/// The results of one noise level by operator and seed, and the estimated σ̂ by seed.
struct LevelResults {
    std::array<std::vector<SeedResult>, 2> of;
    std::vector<NoiseLevel> estimates;
    int iterations = 0;
};

/// Computes one result per level; `iterations` limits each. Seeds run in parallel.
std::vector<LevelResults> results_of_levels(const Work& work, const std::vector<int>& iterations);

/// @param clean_area  of the mesh before the noise
OperatorFacts facts_of(const LaplaceBeltrami& laplacian, double clean_area);

/// The formula with the operators of other noisy meshes, mean over them: what the operator is, but not that it knows the noise.
PredictedCurve formula_of_draws(const Work& work, double sigma, std::size_t level, int iterations, OperatorFacts& facts);

}   // namespace meshfolio::modes
