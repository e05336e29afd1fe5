/// @file
/// What question 7 measures: noisy meshes smoothed implicitly over a grid of steps λ and iterations t, against the clean mesh.
#pragma once

#include "mesh/vertex_noise.h"
#include "questions/bench/denoising_search.h"
#include "questions/core/section_tools.h"

namespace meshfolio::q7_denoising {

/// rms distance to the surface where something is, and everywhere else; NaN where there is no such vertex. [length]
struct Uneven {
    double there = NAN, elsewhere = NAN;
    double times() const { return elsewhere > 0 ? there / elsewhere : NAN; }
};

/// What a smoothed mesh has not got back, or has lost.
struct Remains {
    Uneven features, curved;      // on edges sharper than 40°; where the clean mesh is most curved: a tenth of its vertices
    double feature_angle = NAN;   // mean angle of the normals of faces at such edges, and of the others [rad]
    double other_angle = NAN;
    double volume = NAN;   // over that of the clean mesh; NaN: open
};

/// Where a user without the clean mesh stops: by Stein's estimate with a fitted σ, at the step in the middle of the grid.
struct Stopped {
    int step = 0;
    double gain = NAN;   // by surface; NaN: no σ, or nothing to measure
    double best = NAN;   // at any iteration of that run

    double share() const { return gain / best; }
    /// By the rule of every verdict.
    bool fails() const { return gain < helps; }
    bool harms() const { return gain < 1; }
};

/// Noise of another kind, as strong as that of pictured(), in one run at its λ. Gains by surface.
struct OtherNoise {
    NoiseKind kind{};
    double same = NAN, best = NAN;   // after as many iterations as are best there, and after any
    int best_step = 0;
    double spread = NAN;   // after `same`: rms distance of the vertices that had no noise, over that of the others; NaN: all had some
};

/// One noisy mesh and its results over the grid. λ is in squared mean edges of the clean mesh, h̄².
struct NoisyTrial {
    double relative = 0, sigma = 0;    // of each coordinate [box diagonals], [length]
    double clean_volume = NAN;         // NaN: open [length³]
    TriangleMesh noisy, best;          // best: nearest to the clean surface
    TriangleMesh over;                 // of pictured(): four times as many iterations of the same λ
    TriangleMesh clean_alike;          // of pictured(): the clean mesh after as many as the best, what smoothing itself takes
    std::vector<SearchState> states;   // of all runs, λ by λ
    SearchResult found;
    Remains remains, taken;   // of `best`, of `clean_alike`
    Stopped stopped;
    std::vector<double> further_gains;   // by surface, of further seeds at the λ and t that are best for this one

    bool improved() const { return found.by_shape.step > 0; }   // the distance to the surface
    /// What the best by a measure has of the volume; NaN for an open mesh.
    double volume_by(const Measure& measure) const { return best_by(measure).volume / clean_volume; }
    /// How much of the noisy mesh's squared error the best by surface has lost: that along the surface, and that across it.
    double removed_along() const;
    double removed_across() const { return 1 - std::pow(found.by_shape.shape / found.noisy.shape, 2); }
    /// rms distance along the surface of a state. [length]
    static double drift(const SearchState& state) { return std::sqrt(std::max(0.0, state.rms * state.rms - state.shape * state.shape)); }
    /// NaN where the noise has nothing of the measure.
    double gain(const Measure& measure) const { return (found.*measure.gain)(); }
    /// Standard deviation of the gain by surface over all seeds; NaN where there is one alone.
    double spread() const;
    const SearchState& best_by(const Measure& measure) const { return found.*measure.best; }
};

struct DenoisingGrid {
    SharedMesh clean;
    double diagonal = 0, mean_edge = 0;     // [length]
    std::vector<double> lambdas;            // ascending [h̄²]
    int iterations = 0;                     // of each run, at most
    std::vector<char> on_feature, curved;   // n flags: on edges sharper than 40°, in the most curved tenth
    int feature_vertices = 0;
    std::vector<NoisyTrial> trials;        // ascending σ
    std::vector<OtherNoise> other_noise;   // along the normals, and on a tenth of the vertices; empty where pictured() has no gain
    double fitted_to_clean = NAN;          // the σ that is fitted to the clean mesh: its shape, taken for noise [mean edges]

    const std::string& name() const { return clean->name; }
    double edges(const NoisyTrial& trial) const { return trial.sigma / mean_edge; }
    double middle_lambda() const { return lambdas[lambdas.size() / 2]; }
    /// Do edges stand out from the tessellation?
    bool has_features() const { return feature_vertices > 0 && 2 * feature_vertices <= clean->mesh().vertex_count(); }
    /// The one to look at: the lowest noise whose distance to the surface is halved, else the one that gains most.
    const NoisyTrial& pictured() const;
};

/// What is tried on a mesh of that mean edge.
struct DenoisingTries {
    std::vector<double> noise;     // ascending [box diagonals]
    std::vector<double> lambdas;   // ascending [h̄²]
    int iterations = 0;            // of each run, at most
};
DenoisingTries tries_of(const QuestionSettings& settings, double mean_edge);

/// Every λ on one noisy mesh. A run goes on while some measure has been best in its second half, and for a dozen iterations at least.
/// @param input  its mean edge is that of the clean mesh
/// @param met  called with every state and its positions
SearchResult search_for_best(const SearchInput& input, const std::vector<double>& lambdas, int iterations,
                             const std::function<void(const SearchState&, const Positions&)>& met = {});

/// Noise of so many mean edges is tried beside the levels in box diagonals, which leave a gap there.
inline constexpr double level_in_edges = 0.3;
inline bool tries_in_edges(const QuestionSettings& settings) { return settings.noise.empty() && !settings.quick; }

/// Runs the noise levels of the settings, else from barely visible to hopeless and level_in_edges, with λ from 0.003 h̄² to 3 h̄².
DenoisingGrid denoising_grid(SharedMesh clean, const QuestionSettings& settings);

/// By surface distance alone: "works" (gain ≥ 2), "helps" (≥ 1.1), "fails" (below), "shrinks" (a gain that costs more than 15 % of the
/// volume), "–" (the noise does not move the surface).
std::string verdict_on(const NoisyTrial& trial);
inline constexpr double volume_to_keep = 0.85;
/// Whether the best lies at an end of the amounts λt tried: less or more smoothing may gain more.
bool is_unended(const NoisyTrial& trial, const SearchState& best);

/// Which noise separates the cases in which the distance to the surface is halved. Levels that differ by rounding are one. [mean edges]
struct NoiseSplit {
    double never_to = 0;             // the highest level up to which it never is; 0: none
    double always_from = INFINITY;   // the lowest level from which it always is; ∞: none
    bool decides = false;            // every level is on one of the two sides
};
NoiseSplit noise_split(const std::vector<DenoisingGrid>& grids);

}   // namespace meshfolio::q7_denoising
