/// @file
/// The factor L D Lᵀ of a sparse symmetric matrix, its columns of equal pattern gathered into panels of up to eight so that solving
/// reads and writes a row once for all of them. Private to the layer.
#pragma once

#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

struct LdltPanels {
    static constexpr int widest = 8;

    int size = 0;                           // rows of the matrix
    std::vector<int> first;                 // columns first[p] … first[p+1] − 1 of panel p
    std::vector<std::size_t> row_start;     // in `rows`, of panel p
    std::vector<int> rows;                  // below the panel's own
    std::vector<std::size_t> value_start;   // in `values`: w × w of the panel itself, then w of each row
    std::vector<double> values;
    Vector pivots;            // D
    double growth = 1;        // largest |pivot| over the diagonal entry it came from: what rounding is enlarged by
    double delta = 0;         // LDLᵀ is that of a matrix at most so far off, in the 2-norm (ldlt_rounding.h)
    std::vector<int> order;   // row order[i] of the matrix is eliminated as the i-th

    int panels() const { return static_cast<int>(first.size()) - 1; }
    int negative_pivots() const { return static_cast<int>((pivots.array() < 0).count()); }
};

}   // namespace meshfolio
