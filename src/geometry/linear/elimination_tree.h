/// @file
/// The order in which the columns of a sparse LDLᵀ wait for each other, and how long they become. Private to the layer.
/// Source: Davis, Direct Methods for Sparse Linear Systems (2006), §4.1.
#pragma once

#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

struct EliminationTree {
    std::vector<int> parent;   // the first row below the diagonal in each column of L; −1 where there is none
    std::vector<int> count;    // entries below the diagonal in each column
};

/// Place of each row in the order.
/// @throws MeshError if `order` is no permutation of the rows
std::vector<int> places_of(const std::vector<int>& order, Eigen::Index rows);

/// Of a symmetric A when row order[i] is eliminated as the i-th.
/// @throws MeshError as `places_of`
EliminationTree elimination_tree(const SparseMatrix& A, const std::vector<int>& order);

}   // namespace meshfolio
