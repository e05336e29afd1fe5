/// @file
/// The smallest eigenpairs of one component with a factor that several processes hold together. Private to the layer.
#pragma once

#include "geometry/spectrum/engine/spectrum_modes.h"

namespace meshfolio {

class Ranks;

/// Krylov–Schur on (B + 0.1 I)⁻¹, beside the zero modes; then held against the inertia of A − σM in the gap behind the k-th, and
/// looked for again beside those known as long as more are counted than were found.
/// @param A  −C, @param M  its masses, ΣM = 1
/// @throws SolverError if pairs do not converge, or are counted and not found
Modes distributed_modes(const SparseMatrix& A, const Vector& M, int k, Ranks& ranks);

}   // namespace meshfolio
