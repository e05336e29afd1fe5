/// @file
/// What implicit smoothing with a fixed operator will do to white noise, before there is any. One step is the matrix
/// S = (M − λC)⁻¹M on each coordinate, so that for X + σN, N with 3n independent entries of mean 0 and variance 1,
///   E Σ_i W_i |(Sᵗ(X + σN) − X)_i|² = Σ_c ‖(Sᵗ − I)x_c‖²_W + 3σ² tr(Sᵗᵀ W Sᵗ),
/// exactly. With all modes, −CΦ = MΦ diag(μ), ΦᵀMΦ = I, h = 1/(1 + λμ), ĉ = ΦᵀMX, G = ΦᵀΦ, B = ΦᵀM²Φ:
///   W = M:  Σ_i (1 − h_iᵗ)²|ĉ_i|² + 3σ² Σ_i h_i²ᵗ B_ii
///   W = I:  ‖Φ diag(1 − hᵗ) ĉ‖²   + 3σ² Σ_ij h_iᵗ h_jᵗ G_ij B_ij
/// On larger meshes the bias is that of one run without noise, the trace the mean of zᵀSᵗᵀWSᵗz over fair ±1 z (Hutchinson 1990).
#pragma once

#include <cstdint>

#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/implicit_solver.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// In one norm, after t = 0, 1, … T steps.
struct ExpectedError {
    Vector bias;             // squared, of the run without noise [length² · weight]
    Vector noise;            // what σ² is multiplied by: 3 tr(Sᵗᵀ W Sᵗ) [weight]
    Vector noise_error;      // standard error of `noise` over the probes; 0 where it is exact
    double weight_sum = 0;   // ΣW_i: of the mean square

    int iterations() const { return static_cast<int>(bias.size()) - 1; }
    /// E Σ_i W_i |·|², all T + 1 values.
    Vector squared(double sigma) const { return bias + sigma * sigma * noise; }
    /// √(E Σ_i W_i |·|² / ΣW_i). [length]
    Vector rms(double sigma) const { return (squared(sigma) / weight_sum).cwiseSqrt(); }
    /// The first iteration with the smallest expected error.
    int best(double sigma) const;
};

struct DenoisingPrediction {
    ExpectedError mass;       // W = M: area-weighted
    ExpectedError vertices;   // W = I: the plain rms over the vertices
    int modes = 0;            // all of them, or 0 where probes were used
    int probes = 0;           // or 0 where all modes were
};

struct PredictionOptions {
    double lambda = 0;   // [length²]
    int iterations = 40;
    int modes_up_to = 1000;   // vertices with mass; the cost of all modes grows with their cube
    int probe_triples = 6;    // probes are run three at a time, as coordinates
    std::uint64_t seed = 2000;
};

/// For the operator as it is, whatever mesh it was made from. Vertices without mass are not moved: their noise stays.
/// @throws MeshError if λ is not positive and finite, the iterations are negative, or X has not the operator's rows
DenoisingPrediction denoising_prediction(const LaplaceBeltrami& laplacian, const Positions& X, const PredictionOptions& options);
/// The same with a solver that other runs share, which is left ready for the operator where probes are used.
DenoisingPrediction denoising_prediction(const LaplaceBeltrami& laplacian, const Positions& X, const PredictionOptions& options,
                                         ImplicitSolver& solver);
/// The same by all modes of the operator, where they are known. @param all  as many as vertices with mass
DenoisingPrediction denoising_prediction(const LaplaceBeltrami& laplacian, const Positions& X, const PredictionOptions& options,
                                         const Spectrum& all);

/// n × 3 fair ±1.
Positions random_signs(Eigen::Index rows, std::uint64_t seed);

}   // namespace meshfolio
