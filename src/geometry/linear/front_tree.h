/// @file
/// LDLᵀ by fronts (Duff & Reid 1983): columns of nearly one pattern are eliminated together. Private to the layer.
#pragma once

#include <span>
#include <vector>

#include "geometry/linear/ldlt_panels.h"

namespace meshfolio {

struct FrontTree {
    std::vector<int> order;    // row order[i] of the matrix is eliminated as the i-th; children before their parents, subtrees in one piece
    std::vector<int> place;    // its inverse
    std::vector<int> first;    // columns first[f] … first[f+1] − 1 are those of front f
    std::vector<int> parent;   // the front that what is left of f is added to; −1: none is left
    std::vector<std::size_t> row_start;
    std::vector<int> rows;    // below the columns of front f, ascending: from row_start[f] on
    long long nonzeros = 0;   // of the factor, diagonal included

    int fronts() const { return static_cast<int>(parent.size()); }
    int columns(int f) const { return first[std::size_t(f) + 1] - first[std::size_t(f)]; }
    std::span<const int> rows_below(int f) const {
        return {rows.data() + row_start[std::size_t(f)], rows.data() + row_start[std::size_t(f) + 1]};
    }
    long long entries() const;   // that are stored: nonzeros, and the zeros that join columns
};

/// @param A      compressed, symmetric, both triangles stored
/// @param order  which keeps the factor sparse; its columns are put in postorder, which changes no entry
FrontTree front_tree(const SparseMatrix& A, const std::vector<int>& order);

/// LDLᵀ of A − σI by dense matrices, one for each front, to which the children add what they have left. No pivoting. Eigen and CHOLMOD
/// factor LDLᵀ column by column: the 36 M entries of 692 000 rows take CHOLMOD 12.2 s of processor, and fronts 1.4 to 1.8 s.
///
/// Pivots are not looked at: a vanishing one leaves numbers that are not finite. Each entry is what it would be column by
/// column, a_ij − Σ l_ik (d_k l_jk), summed over ascending k within a front and over the fronts in a fixed order, whatever the threads.
/// @param A         of the tree's pattern, both triangles stored, every diagonal entry too
/// @param parallel  subtrees side by side, then the columns of large fronts
LdltPanels factor_by_fronts(const SparseMatrix& A, double sigma, const FrontTree& tree, bool parallel);

}   // namespace meshfolio
