/// @file
/// Incomplete factorisation L D Lᵀ without fill (Meijerink & van der Vorst 1977) of the diagonal blocks of a matrix: a preconditioner
/// whose blocks are worked on at the same time, and which is the same for any number of threads. Private to the layer.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/linear/aligned_columns.h"

namespace meshfolio {

struct IncompleteCholesky {
    std::vector<std::uint32_t> start;   // of row i of L below; one more than rows
    std::vector<std::int32_t> column;   // ascending, < i, in the block of i
    std::vector<double> value;
    Vector pivots;      // D, all > 0
    double shift = 0;   // the largest by which the diagonal of a block had to be raised, relative; 0 for matrices with C_ij ≥ 0

    int rows() const { return static_cast<int>(pivots.size()); }
};

/// Of A: symmetric, positive definite, rows in an order in which neighbours are near; blocks are those of mesh/parallel.h. Where a pivot
/// is not safely positive the block is taken again with a larger diagonal (Manteuffel 1980).
/// @throws SolverError if a diagonal entry is not positive and finite
IncompleteCholesky incomplete_cholesky(const SparseMatrix& A);

/// Z := (LDLᵀ)⁻¹ R.
void solve(const IncompleteCholesky& factor, const FourColumns& R, FourColumns& Z);

}   // namespace meshfolio
