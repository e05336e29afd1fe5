/// @file
/// Rounding leaves noise of the highest modes in what block Lanczos finds, which Ritz values do not show and residuals do. Private to the
/// layer.
#pragma once

#include "geometry/spectrum/engine/spectrum_slice.h"

namespace meshfolio {

/// y := y − (B + cI)⁻¹(By − μy), c the largest μ, for the groups whose residuals are larger than they should be: an error in a mode λ is
/// multiplied by (μ + c)/(λ + c). So noise in the highest modes, which needles make large in the residual, is damped, and nothing grows to
/// more than twice. Done again while that makes the largest residual smaller, three times at most; then they stay as they are, and the
/// residuals say so.
/// @param X  orthonormal, a column for each of mu, in the order of elimination; orthonormal again afterwards
void damp_noise(const SpectrumProblem& problem, std::vector<EightColumns>& X, const Vector& mu);

}   // namespace meshfolio
