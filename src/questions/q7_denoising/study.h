/// @file
/// The measurements of question 7: noisy meshes smoothed implicitly over a grid of steps λ and iterations t, against the clean mesh;
/// and why denoising can work: shape and noise mode by mode, and the error as noise left and shape lost.
#pragma once

#include "mesh/vertex_noise.h"
#include "questions/bench/denoising_search.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

/// rms distance to the clean surface at some vertices, and at all others; NaN over no vertex. [length]
struct SplitRms {
    double there = NAN, elsewhere = NAN;
    double times() const { return elsewhere > 0 ? there / elsewhere : NAN; }
};

/// Errors of a smoothed mesh against the clean mesh.
struct SurfaceErrors {
    SplitRms features, curved;    // at edges sharper than 40°; at the most curved tenth of the vertices
    double feature_angle = NAN;   // mean error of the normals of faces at such edges [rad]
    double other_angle = NAN;     // mean error of the other normals [rad]
    double volume = NAN;          // over that of the clean mesh; NaN: open
};

/// A run stopped without the clean mesh: by Stein's estimate with a fitted σ, at the step in the middle of the grid.
struct Stopped {
    int step = 0;
    double gain = NAN;   // by surface; NaN: no σ, or nothing to measure
    double best = NAN;   // largest gain at any iteration of that run

    double share() const { return gain / best; }
    bool fails() const { return gain < helps; }
    bool harms() const { return gain < 1; }
};

/// Noise of another kind, as strong as that of pictured(), in one run at its λ. Gains by surface.
struct OtherNoise {
    NoiseKind kind{};
    double same = NAN, best = NAN;   // after the best number of iterations of pictured(); after any number
    double spread = NAN;             // with `same`: rms distance of vertices without noise over that of the others; NaN: all had noise
};

/// One noisy mesh and its results over the grid. λ is in squared mean edges of the clean mesh, h̄².
struct NoisyTrial {
    double relative = 0, sigma = 0;    // standard deviation of each coordinate [box diagonals], [length]
    double clean_volume = NAN;         // NaN: open [length³]
    TriangleMesh noisy, best;          // best: nearest to the clean surface
    TriangleMesh over;                 // of pictured(): four times the best number of iterations, same λ
    TriangleMesh clean_alike;          // of pictured(): the clean mesh, smoothed like the best
    std::vector<SearchState> states;   // of all runs, λ by λ
    SearchResult found;
    SurfaceErrors residual, clean_loss;   // of `best`; of `clean_alike`
    Stopped stopped;
    std::vector<double> further_gains;   // by surface, of further seeds at the best λ and t of this one

    /// True if some step of some run is nearer to the clean surface than the noisy mesh is.
    bool improved() const { return found.by_shape.step > 0; }
    /// Returns the volume of the best by a measure, over that of the clean mesh; NaN for an open mesh.
    double volume_by(const Measure& measure) const { return best_by(measure).volume / clean_volume; }
    /// Return the share of the noisy mesh's squared error, along and across the surface, that the best by surface has removed.
    double removed_along() const;
    double removed_across() const { return 1 - std::pow(found.by_shape.shape / found.noisy.shape, 2); }
    /// Returns the rms distance of a state from the clean vertices along the surface. [length]
    static double drift(const SearchState& state) { return std::sqrt(std::max(0.0, state.rms * state.rms - state.shape * state.shape)); }
    /// Returns the noisy error over the least error by a measure, ≥ 1; NaN if the noisy error is 0.
    double gain(const Measure& measure = measures[0]) const { return (found.*measure.gain)(); }
    /// Returns the product λt of the best by surface. [h̄²]
    double amount() const { return found.by_shape.value * found.by_shape.step; }
    /// Returns the standard deviation of the gain by surface over all seeds; NaN for one seed.
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
    std::vector<OtherNoise> other_noise;   // along the normals, and on a tenth of the vertices; empty if pictured() has no gain
    double fitted_to_clean = NAN;          // σ fitted to the clean mesh, whose shape is taken for noise [mean edges]

    const std::string& name() const { return clean->name; }
    double edges(const NoisyTrial& trial) const { return trial.sigma / mean_edge; }
    double middle_lambda() const { return lambdas[lambdas.size() / 2]; }
    /// True if sharp edges stand out from the tessellation: at most half of the vertices are on some.
    bool has_features() const { return feature_vertices > 0 && 2 * feature_vertices <= clean->mesh().vertex_count(); }
    /// Returns the trial that figures show: the lowest noise with the distance to the surface halved, else the largest gain.
    const NoisyTrial& pictured() const;
};

/// The noise levels and steps that are tried.
struct DenoisingTries {
    std::vector<double> noise;     // ascending [box diagonals]
    std::vector<double> lambdas;   // ascending [h̄²]
    int iterations = 0;            // of each run, at most
};
/// Returns the tries of the settings, else σ = 0.1, 0.3, 1, 3 % (quick: 0.3, 1), λ = 0.003 to 3 h̄² in steps of ten (quick: 0.01 to 1), 32
/// iterations (quick: 16). @param mean_edge  h̄ of the mesh [length]
DenoisingTries tries_of(const QuestionSettings& settings, double mean_edge);

/// Searches the states with the least error of each measure over all λ [h̄²] on one noisy mesh. A run ends, after twelve iterations at
/// least, once no measure has been best in its second half.
/// @param input  its mean edge is that of the clean mesh
/// @param met    called with every state and its positions
SearchResult search_for_best(const SearchInput& input, const std::vector<double>& lambdas, int iterations,
                             const std::function<void(const SearchState&, const Positions&)>& met = {});

/// A further level of noise, beside the default levels in box diagonals. [mean edges]
inline constexpr double level_in_edges = 0.3;
/// True if level_in_edges is tried: in runs that are not quick, if the settings name no noise.
inline bool tries_in_edges(const QuestionSettings& settings) { return settings.noise.empty() && !settings.quick; }

/// Smooths the mesh with every level of noise and every λ of tries_of(), and level_in_edges if tries_in_edges(); levels ascend.
DenoisingGrid denoising_grid(SharedMesh clean, const QuestionSettings& settings);

/// Returns "–" if the noise does not move the surface, "fails" for a gain by surface below 1.1, "shrinks" if a larger gain costs more than
/// 15 % of the volume, else "works" for a gain of 2 or more, else "helps".
std::string verdict_on(const NoisyTrial& trial);
inline constexpr double volume_to_keep = 0.85;
/// True if `best` lies at the least or the largest λt of the trial's states, so that less or more smoothing may gain more.
bool lies_at_an_end(const NoisyTrial& trial, const SearchState& best);

/// Noise levels that separate the cases with the distance to the surface halved from the others. [mean edges]
struct NoiseSplit {
    double never_to = 0;             // highest level up to which no error is halved; 0: none
    double always_from = INFINITY;   // lowest level from which every error is halved; ∞: none
    bool decides = false;            // every level is on one of the two sides
};
/// Returns the split over all trials of all grids with a gain that is not NaN; levels that differ by rounding count as one.
NoiseSplit noise_split(const Grids& grids);

using Case = Within<DenoisingGrid, NoisyTrial>;

/// Returns every trial of every grid.
inline std::vector<Case> cases_of(const Grids& grids) { return parts_within(grids, &DenoisingGrid::trials); }

/// Coefficients |Φᵀ M X| of the clean mesh and |Φᵀ M N| of the noise of a trial, rms over bands of modes. The unit is the expected noise of
/// a mode, σ √(3 ΣM/n), which is exactly the mean over all modes: E|Φᵀ M N|² = 3σ² tr(ΦᵀM²Φ), ΦΦᵀ = M⁻¹.
struct ModeBands {
    std::vector<double> mu;             // geometric mean of the band [1/h̄²]
    std::vector<double> shape, noise;   // [noise of a mode]
    std::vector<double> kept;           // factor of a mode of this μ in the best smoothing with the same operator, (1 + λμ)⁻ᵗ
    int modes = 0, above = 0;           // without the constant ones; with waves longer than at the crossing
    bool all = false;                   // `modes` are all modes of the mesh

    bool crosses() const { return above > 0 && above < modes; }
    double crossing = NAN;                                               // μ where shape falls below noise, between bands [1/h̄²]
    double wavelength() const { return 2 * pi / std::sqrt(crossing); }   // [h̄]
};

/// An error over the amount of smoothing.
struct ErrorCurve {
    std::vector<double> amount, error;   // λt, ascending from 0 [h̄²]; [h̄]
    /// Returns the index of the least error.
    std::size_t least() const { return std::ranges::min_element(error) - error.begin(); }
};

/// The error as the noise left and the shape lost: S(X + N) − X = SN + (SX − X) for the linear operator S of the clean mesh. All but
/// `surface` are measured along the vertex normals of the clean mesh, where displacements add up.
struct ErrorParts {
    ErrorCurve total, noise, shape;   // of the same amounts
    ErrorCurve surface;               // surface distance of the smoothed clean mesh
    double best_lambda = 0;           // of the least total [h̄²]
    int best_step = 0;                // 0: the noisy mesh itself

    /// Returns the largest |(noise² + shape²)/error² − 1| up to twice the best amount; 0 in the mean over the noise.
    double deviation_of_sum() const;
};

/// Modes and error curves of the smallest mesh with a gain.
struct Reasons {
    const DenoisingGrid* grid = nullptr;
    ModeBands bands;                  // of pictured(); empty if the modes were not found
    ErrorParts parts;                 // of pictured()
    std::vector<ErrorCurve> levels;   // of each trial
};

/// True if each curve of `levels` with its minimum inside ends nearer to parts.surface than it is at the minimum, as a ratio; false without
/// such a curve.
bool approaches_clean_curve(const Reasons& reasons);

/// Joins the runs of all λ, ascending, to one curve of the error [mean edges] over the amount λ · steps, from 0 on: each run from its third
/// step on (the first run from its first), beyond the amounts of the runs before.
ErrorCurve error_curve(const DenoisingGrid& grid, const NoisyTrial& trial);
/// Smooths a noisy mesh and the clean mesh by the operator of the clean mesh with every λ of the grid, and splits the error.
ErrorParts error_parts(const DenoisingGrid& grid, const TriangleMesh& noisy);
/// Computes the bands from all modes of a mesh of up to 700 vertices, else from the 150 smoothest. @param parts  error_parts() of this
/// trial
/// @throws SolverError if the modes are not found
ModeBands mode_bands(const DenoisingGrid& grid, const NoisyTrial& trial, const ErrorParts& parts);
/// Computes the modes and error curves of the smallest mesh with a gain in pictured(); grid is null if there is none.
Reasons reasons_of(const Grids& grids);

/// Returns the facts of labels about one trial and its best by surface.
report::Facts facts_of(const DenoisingGrid& grid, const NoisyTrial& trial);
/// Returns the grid with the largest drift of pictured() along the surface [σ], of those where smoothing removes a smaller share of the
/// error along the surface than across it; null if there are none.
const DenoisingGrid* most_drifting(const Grids& grids);
/// Returns the grid with the largest clean_loss.features.times() of pictured(), of those above 1.2 with a gain; null if there are none.
const DenoisingGrid* most_rounded(const Grids& grids);
/// Returns the grid with the largest loss of volume in clean_loss of pictured(), of those above 0.1 % with a gain; null if there are none.
const DenoisingGrid* most_shrunk(const Grids& grids);

}   // namespace meshfolio::q7_denoising
