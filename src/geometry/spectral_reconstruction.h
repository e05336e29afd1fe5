/// @file
/// A mesh rebuilt from its k smoothest modes: X_k = Φ_k Φ_kᵀ M X.
#pragma once

#include "geometry/laplace_spectrum.h"

namespace meshfolio {

/// k × 3 coefficients Φᵀ M X. [length²]
DenseMatrix spectral_coefficients(const Spectrum& spectrum, const Vector& M, const Positions& X);

/// X_k from the first k modes. Unreferenced vertices keep their position.
Positions reconstruct(const Spectrum& spectrum, const Vector& M, const Positions& X, int k);

/// Entry k: √(‖X − X_k‖²_M / ΣM) for k = 0 … number of modes, from the coefficients alone (Parseval). [length]
Vector reconstruction_rms(const Spectrum& spectrum, const Vector& M, const Positions& X);

}   // namespace meshfolio
