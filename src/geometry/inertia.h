/// @file
/// How many eigenvalues lie below a number, by Sylvester's law of inertia.
#pragma once

#include <optional>

#include "geometry/sparse_types.h"

namespace meshfolio {

/// Negative pivots of A − σM.
/// @throws SolverError if a pivot is lost in rounding: σ is an eigenvalue, or next to one
int inertia_below(const SparseMatrix& A, const Vector& M, double sigma);

struct Inertia {
    double sigma = 0;
    int below = 0;   // negative pivots of A − σM
};
/// At some σ between two numbers. Symmetric matrices have shifts, far from any eigenvalue, at which a pivot vanishes and 2 × 2 pivots
/// would be needed; a little beside it does as well.
/// @return nothing if every σ tried loses a pivot: the two are too near each other
std::optional<Inertia> inertia_between(const SparseMatrix& A, const Vector& M, double low, double high);

}   // namespace meshfolio
