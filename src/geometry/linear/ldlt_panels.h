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
    std::vector<int> order;   // row order[i] of the matrix is eliminated as the i-th

    int panels() const { return static_cast<int>(first.size()) - 1; }
    int negative_pivots() const { return static_cast<int>((pivots.array() < 0).count()); }
};

/// δ with |xᵀEx| ≤ δ xᵀWx for all x, where L D Lᵀ = A + E holds exactly for the computed factors, unpivoted, of A.
///
/// An entry of A with m products behind it is left with |E_ij| ≤ γ_{m+1} (|L||D||Lᵀ|)_ij, γ_m = mu/(1 − mu), u = 2⁻⁵³, in whatever order
/// they are summed (Higham 2002, lemma 8.4 and theorem 9.3, with one rounding more for l_ij = y_j/d_j, or for d_j l_ij where y_j is not
/// kept). Row i of L has t_i entries left of the diagonal, so m ≤ min(t_i, t_j). For any x > 0 the norm of W^−½EW^−½ is at most
/// max_i (|E|x)_i/(W_i x_i) (Collatz–Wielandt):
///     δ = u · max_i (t_i + 3)(|L||D||Lᵀ|x)_i / (W_i x_i).
/// Of the three, one is that of the division, one is left to the caller for rounding A's diagonal to u|A_ii| ≤ u(|L||D||Lᵀ|)_ii, and one
/// covers the terms of order u². Products that underflow add 2⁻¹⁰²² each. x is 1 in the first pass over L and improved in each further one.
/// @param W       a weight > 0 for each row of A
/// @param passes  over L; measured on surfaces, two leave δ two to four times smaller than one
/// @return        infinity where a number is not finite
double backward_error(const LdltPanels& factor, const Vector& W, int passes = 2);

/// The same of a factor of A − σI in the 2-norm, that of forming A − σI included.
double shifted_backward_error(const LdltPanels& factor, double sigma);

}   // namespace meshfolio
