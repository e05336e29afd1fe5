/// @file
/// What question 7 measures: noisy meshes smoothed implicitly over a grid of steps λ and iterations t, against the clean mesh.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "questions/bench/denoising_search.h"
#include "questions/core/mesh_library.h"
#include "questions/core/settings.h"

namespace meshfolio::q7_denoising {

/// What smoothing is judged by. Each measure has its own best λ and t.
struct Measure {
    std::string_view key;   // "surface": of its words
    Gain gain;
    SearchState SearchResult::*best;
    double SearchState::*error;   // [length], of normals [rad]
};
/// Distance to the clean surface, to the vertices' own places, angle to the clean normals.
inline constexpr std::array measures{
    Measure{"surface", &SearchResult::gain, &SearchResult::by_shape, &SearchState::shape},
    Measure{"places", &SearchResult::rms_gain, &SearchResult::by_rms, &SearchState::rms},
    Measure{"normals", &SearchResult::angle_gain, &SearchResult::by_angle, &SearchState::angle},
};

/// One noisy mesh, and what the grid made of it. λ is in squared mean edges of the clean mesh, h̄².
struct NoisyTrial {
    double relative = 0, sigma = 0;    // of each coordinate [box diagonals], [length]
    TriangleMesh noisy, best;          // best: nearest to the clean surface
    TriangleMesh over;                 // four times as many iterations of the same λ
    std::vector<SearchState> states;   // of all runs, λ by λ
    SearchResult found;
    double on_features = 0, elsewhere = 0;   // rms distance to the surface of the best, NaN without such vertices [length]

    /// NaN where the noise has nothing of the measure.
    double gain(const Measure& measure) const { return (found.*measure.gain)(); }
    const SearchState& best_by(const Measure& measure) const { return found.*measure.best; }
};

struct DenoisingGrid {
    std::shared_ptr<const LibraryMesh> clean;
    double diagonal = 0, mean_edge = 0;   // [length]
    std::vector<double> lambdas;          // ascending [h̄²]
    int iterations = 0;                   // of each run, at most
    std::vector<char> on_feature;         // n flags
    int feature_vertices = 0;
    std::vector<NoisyTrial> trials;      // ascending σ
    std::vector<double> without_noise;   // distance to the surface after t = 0, 1, … iterations of middle_lambda() from the clean mesh

    const std::string& name() const { return clean->name; }
    double middle_lambda() const { return lambdas[lambdas.size() / 2]; }
};

/// At the noise levels of the settings, else from barely visible to hopeless; steps λ from a thousandth of a squared mean edge to one.
DenoisingGrid denoising_grid(std::shared_ptr<const LibraryMesh> clean, const QuestionSettings& settings);

/// "works" (gain ≥ 2), "helps" (≥ 1.2), "fails" (below), "no gain" (nothing tried is better than the noisy mesh), "–" (nothing to measure).
std::string verdict_on(double gain);

/// The lowest noise that smoothing helps against by this measure, ∞ for none, and the highest that it does not, 0 for none. [mean edges]
struct NoiseSplit {
    double smallest_helped = INFINITY, largest_failed = 0;
};
NoiseSplit noise_split(const std::vector<DenoisingGrid>& grids, const Measure& measure);

}   // namespace meshfolio::q7_denoising
