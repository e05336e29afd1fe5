/// @file
/// The effect of implicit smoothing with a fixed operator on white noise, predicted from the clean mesh. One step is the matrix
/// S = (M − λC)⁻¹M on each coordinate. For X + σN, where N has 3n independent entries of mean 0 and variance 1,
///   E Σ_i W_i |(Sᵗ(X + σN) − X)_i|² = Σ_c ‖(Sᵗ − I)x_c‖²_W + 3σ² tr(Sᵗᵀ W Sᵗ),
/// exactly. With all modes, −CΦ = MΦ diag(μ), ΦᵀMΦ = I, h = 1/(1 + λμ), ĉ = ΦᵀMX, G = ΦᵀΦ, B = ΦᵀM²Φ:
///   W = M:  Σ_i (1 − h_iᵗ)²|ĉ_i|² + 3σ² Σ_i h_i²ᵗ B_ii
///   W = I:  ‖Φ diag(1 − hᵗ) ĉ‖²   + 3σ² Σ_ij h_iᵗ h_jᵗ G_ij B_ij
/// On larger meshes the bias comes from one run without noise, the trace is the mean of zᵀSᵗᵀWSᵗz over fair ±1 z (Hutchinson 1990).
#pragma once

#include <cstdint>

#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// The expected squared error in one norm, W = M or W = I, after t = 0, 1, … T steps.
struct ExpectedError {
    Vector bias;             // squared error of the run without noise [length² · weight]
    Vector noise;            // the factor of σ²: 3 tr(Sᵗᵀ W Sᵗ) [weight]
    Vector noise_error;      // standard error of `noise` over the probes; 0 where it is exact
    double weight_sum = 0;   // ΣW_i

    int iterations() const { return static_cast<int>(bias.size()) - 1; }
    /// Returns the expected squared error bias + σ² noise after t = 0 … T steps, for noise of standard deviation σ. [length² · weight]
    Vector squared(double sigma) const { return bias + sigma * sigma * noise; }
    /// Returns √(squared(σ)/ΣW_i), the expected rms error after t = 0 … T steps. [length]
    Vector rms(double sigma) const { return (squared(sigma) / weight_sum).cwiseSqrt(); }
    /// Returns the t with the smallest expected error for noise σ; on a tie the first.
    int best(double sigma) const;
};

struct DenoisingPrediction {
    ExpectedError mass;       // W = M: area-weighted
    ExpectedError vertices;   // W = I: the plain rms over the vertices
    int modes = 0;            // number of modes used, all of them; 0 if probes were used
    int probes = 0;           // number of probes used; 0 if modes were
};

struct PredictionOptions {
    double lambda = 0;   // [length²]
    int iterations = 40;
    int modes_up_to = 1000;   // use modes up to this number of vertices with mass; the cost grows with their cube
    int probe_triples = 6;    // probes are run three at a time, as coordinates
    std::uint64_t seed = 2000;
};

/// Predicts the error of implicit smoothing of X + noise with this operator, from all its modes on up to `modes_up_to` vertices with mass,
/// else from probes. Vertices without mass do not move: their noise stays.
/// @throws MeshError if λ is not positive and finite, the iterations are negative, or X has not the operator's rows
DenoisingPrediction denoising_prediction(const LaplaceBeltrami& laplacian, const Positions& X, const PredictionOptions& options);
/// Predicts the error of implicit smoothing of X + noise from modes that are known. @param all  all modes of the operator, as many as
/// vertices with mass
DenoisingPrediction denoising_prediction(const LaplaceBeltrami& laplacian, const Positions& X, const PredictionOptions& options,
                                         const Spectrum& all);

/// Returns a rows × 3 matrix of random ±1 with equal probability.
Positions random_signs(Eigen::Index rows, std::uint64_t seed);

}   // namespace meshfolio
