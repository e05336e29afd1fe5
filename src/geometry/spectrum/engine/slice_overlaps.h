/// @file
/// Eigenvectors of different slices are orthogonal to their tolerance only; what is left is measured and removed. Private to the layer.
#pragma once

#include <vector>

#include "geometry/spectrum/engine/spectrum_slice.h"

namespace meshfolio {

inline constexpr int lanes = EightColumns::width;

/// Makes the first k columns of the groups orthonormal, one after the other, E = XᵀX − I being so small that its square does not count.
/// The later one of two gives way: its eigenvalue is the larger, and so is what its residual may be.
/// @return ‖E‖ before, largest entry
double make_orthonormal(std::vector<EightColumns>& X, int k);

/// Rounding leaves noise of the highest modes in what block Lanczos finds, which Ritz values do not show and residuals do. This damps it:
/// y := y − (B + cI)⁻¹(By − μy), c the largest μ, for the groups whose residuals are larger than they should be: an error in a mode λ is
/// multiplied by (μ + c)/(λ + c). So noise in the highest modes, which needles make large in the residual, is damped, and nothing grows to
/// more than twice. Repeated, three times at most, while that makes the largest residual smaller.
/// @param X  orthonormal, a column for each of mu, in the order of elimination; orthonormal again afterwards
void damp_noise(const SpectrumProblem& problem, std::vector<EightColumns>& X, const Vector& mu);

}   // namespace meshfolio
