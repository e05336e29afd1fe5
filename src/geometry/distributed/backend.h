/// @file
/// Who factors: this process, or several together. The commands choose one and hand it on; nothing else knows of it.
#pragma once

#include "geometry/smoothing/implicit_solver.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

class Ranks;

/// For SpectrumOptions, certify_spectrum() and SmoothingOptions; as it is, this process alone.
struct Backend {
    SpectrumEngine engine = {};
    InertiaAt inertia_at = meshfolio::inertia_at;
    FactorRemotely factor = {};
};

/// Of ranks, which must outlive it.
///
/// Eigenpairs by Krylov–Schur on (B + 0.1 I)⁻¹, beside the constant; then held against the inertia of A − σM in the gap behind the k-th,
/// and looked for again beside those known as long as more are counted than were found. The ranks hand out no pivot of their factor, so
/// that the δ of a count is measured and not proved: what E does to a random x is the residual of the solve for x: ten of them, rounding of
/// their own included, times twenty bound E in the norm of M, too small with probability 1e-10.
Backend backend_of(Ranks& ranks);

}   // namespace meshfolio
