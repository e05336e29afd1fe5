/// @file
/// Inner loops of smoothing for the vectors of this processor, chosen at run time (Highway). A coordinate is a lane, sums over a row go
/// in the order of its entries and products are rounded before they are added: the same bytes on every processor. Private to the layer.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/linear/aligned_columns.h"
#include "geometry/linear/incomplete_cholesky.h"

namespace meshfolio {

/// Off-diagonal entries of a matrix whose rows sum to 0, row by row.
struct DifferenceRows {
    std::vector<std::uint32_t> start;   // of row i in the two below; one more than rows
    std::vector<std::int32_t> column;
    std::vector<double> weight;

    int rows() const { return static_cast<int>(start.size()) - 1; }
};

/// y_i = x_i + λ Σ_j w_ij (x_j − x_i) for the rows [first, last).
/// @return  whether all |y| there are finite and at most `bound`
bool explicit_rows(const DifferenceRows& L, double lambda, const double* x, int first, int last, double bound, double* y);

/// z := (LDLᵀ)⁻¹ r in the rows [first, last), which are whole blocks of the factor.
void incomplete_solve(const IncompleteCholesky& factor, const double* r, int first, int last, double* z);

}   // namespace meshfolio
