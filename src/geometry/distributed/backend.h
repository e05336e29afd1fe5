/// @file
/// The choice between factors of this process and of several processes together. Only commands make it.
#pragma once

#include "geometry/linear/inertia.h"
#include "geometry/smoothing/implicit_solver.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

class Ranks;

/// Functions for SpectrumOptions, certify_spectrum() and SmoothingOptions; by default of this process alone.
struct Backend {
    SpectrumEngine engine = {};
    InertiaAt inertia_at = meshfolio::inertia_at;
    FactorRemotely factor = {};
};

/// Returns functions that let `ranks` factor, count and find eigenpairs; `ranks` must outlive them.
///
/// Eigenpairs by Krylov–Schur on (B + 0.1 I)⁻¹, beside the constant; then compared with the inertia of A − σM in the gap above the k-th,
/// and searched again, beside those known, while more are counted than were found. The ranks give no pivots of their factor, so the δ of a
/// count is measured, not proved: the effect of E on a random x is the residual of the solve for x; ten of them, with their own rounding,
/// times twenty bound E in the norm of M, too small with probability 1e-10.
Backend backend_of(Ranks& ranks);

}   // namespace meshfolio
