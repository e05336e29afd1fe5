/// @file
/// Symbolic analysis for LDLᵀ by fronts (Duff & Reid 1983): columns of nearly one pattern are eliminated together. Private to the layer.
#pragma once

#include <span>
#include <vector>

#include "geometry/linear/sparse_types.h"

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

}   // namespace meshfolio
