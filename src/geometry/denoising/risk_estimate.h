/// @file
/// The error of a denoised mesh, estimated from the noisy mesh alone (Stein 1981). For X + σN with independent normal N and any weakly
/// differentiable F,
///   E‖F(Y) − X‖² = E[‖F(Y) − Y‖² − 3nσ² + 2σ² div F(Y)],   div F = Σ ∂F_i/∂Y_i,
/// even where the operator is made from Y itself. The divergence is that of the run as a black box, zᵀ(F(Y + εz) − F(Y))/ε with random
/// ±1 in z (Ramani, Blu & Unser 2008).
#pragma once

#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// Positions after t = 0, 1, … T steps.
using Trajectory = std::vector<Positions>;

/// The terms of the estimate after t = 0, 1, … T steps.
struct RiskEstimate {
    Vector residual;      // ‖F_t(Y) − Y‖² [length²]
    Vector divergence;    // of F_t at Y: 3n for t = 0
    double numbers = 0;   // 3n

    /// Returns the estimates of the squared error ‖F_t(Y) − X‖² after t = 0 … T steps for noise σ; may be negative. [length²]
    Vector risk(double sigma) const;
    /// Returns the t of smallest risk. Smoothing lowers the divergence; once it has risen by more than a twentieth of 3n, triangles
    /// collapse, and later iterations are ignored.
    int best(double sigma) const;
    /// Returns the t of the discrepancy principle (Morozov 1966): the first with ‖F_t(Y) − Y‖² ≥ 3nσ², or the last.
    int by_discrepancy(double sigma) const;
};

/// Returns the terms of the estimate from two runs of one method.
/// @param run, moved  positions from Y, and from Y + amount · direction
/// @throws MeshError if they are not equally long, or empty
RiskEstimate risk_estimate(const Trajectory& run, const Trajectory& moved, const Positions& direction, double amount);

}   // namespace meshfolio
