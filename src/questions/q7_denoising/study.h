/// @file
/// What question 7 measures: noisy meshes smoothed implicitly over a grid of steps λ and iterations t, against the clean mesh.
#pragma once

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
};

/// One noisy mesh and its results over the grid. λ is in squared mean edges of the clean mesh, h̄².
struct NoisyTrial {
    double relative = 0, sigma = 0;    // of each coordinate [box diagonals], [length]
    double clean_volume = NAN;         // NaN: open [length³]
    TriangleMesh noisy, best;          // best: nearest to the clean surface
    TriangleMesh over;                 // four times as many iterations of the same λ; of the pictured, the hardest and the leading trial
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
    double thickness = NAN;                 // 3 × volume / area, the radius of a ball of that ratio; NaN: open [mean edges]
    std::vector<double> lambdas;            // ascending [h̄²]
    int iterations = 0;                     // of each run, at most
    std::vector<char> on_feature, curved;   // n flags: on edges sharper than 40°, in the most curved tenth
    int feature_vertices = 0;
    std::vector<NoisyTrial> trials;      // ascending σ
    std::vector<double> without_noise;   // distance to the surface after t = 0, 1, … iterations of middle_lambda() from the clean mesh

    double fitted_to_clean = NAN;   // the σ that is fitted to the clean mesh: its shape, taken for noise [mean edges]

    double noisy_area = 1;   // of pictured(), over the area of the clean mesh
    std::vector<double>
        other_gains;   // by surface, of pictured()'s λ and t on noise as strong along the normals, and on a tenth of the vertices
    double kept_by_less = NAN;   // volume of the clean mesh smoothed as pictured() was, but with λ divided by that; NaN: open

    const std::string& name() const { return clean->name; }
    /// What one iteration of middle_lambda() takes from the clean mesh, over the noise. NaN where the noise is along the surface.
    double taken_at_once(const NoisyTrial& trial) const;
    /// The distance to the surface after that iteration, over that of the noisy mesh; NaN as above.
    double after_one(const NoisyTrial& trial) const;
    /// What pictured()'s λ and t leave of the radius r = 3V/A of a ball: on it the coordinates are modes with μ = 2/r². NaN: open.
    double ball_kept() const;
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

/// Runs the noise levels of the settings, else from barely visible to hopeless, with λ from 0.001 h̄² to 10 h̄².
DenoisingGrid denoising_grid(SharedMesh clean, const QuestionSettings& settings);

/// Measures how far each vertex of X is from its clean place: along the surface, and below it. [length]
Vector drifts(const DenoisingGrid& grid, const Positions& X);
Vector sinkings(const DenoisingGrid& grid, const Positions& X);

/// "works" (gain ≥ 2), "helps" (≥ 1.1), "fails" (below), "shrinks" (a gain that costs more than 15 % of the volume), "–" (no noise in it).
std::string verdict_on(const NoisyTrial& trial, const Measure& measure = measures[0]);
/// Whether the best lies at an end of the grid. The smallest λ is no end while t can grow: more of its steps do the same.
bool is_unended(const DenoisingGrid& grid, const SearchState& best);

inline bool is_failure(const std::string& verdict) { return verdict == "fails" || verdict == "shrinks"; }

/// The lowest noise whose distance to the surface is halved, ∞ for none, and the highest that is not, 0 for none. [mean edges]
struct NoiseSplit {
    double smallest_halved = INFINITY, largest_other = 0;

    bool decides() const { return largest_other > 0 && largest_other < smallest_halved && std::isfinite(smallest_halved); }
};
NoiseSplit noise_split(const std::vector<DenoisingGrid>& grids);

}   // namespace meshfolio::q7_denoising
