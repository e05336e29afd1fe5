/// @file
/// What a sparse factorisation costs, counted from the pattern alone.
#pragma once

#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// How the columns of a sparse LDLᵀ depend on each other, and how long they become (Davis, Direct Methods for Sparse Linear Systems, §4.1).
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

struct FactorOperations {
    long long nonzeros = 0;     // of the factor, diagonal included
    double factorisation = 0;   // multiply–adds of LDLᵀ
    double solve = 0;           // multiply–adds of one solve with one right-hand side: L, D and Lᵀ
};

/// Of LDLᵀ of a symmetric matrix with A's pattern, row order[i] eliminated as the i-th. Zeros stored to work in blocks are not counted.
/// @throws MeshError if `order` is no permutation of the rows
FactorOperations factor_operations(const SparseMatrix& A, const std::vector<int>& order);

}   // namespace meshfolio
