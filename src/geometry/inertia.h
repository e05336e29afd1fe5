/// @file
/// How many eigenvalues lie below a number, by Sylvester's law of inertia.
#pragma once

#include "geometry/sparse_types.h"

namespace meshfolio {

/// Negative pivots of A − σM.
/// @throws SolverError if a pivot is lost in rounding: σ is an eigenvalue, or next to one
int inertia_below(const SparseMatrix& A, const Vector& M, double sigma);

}   // namespace meshfolio
