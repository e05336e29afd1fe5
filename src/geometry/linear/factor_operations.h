/// @file
/// What a sparse factorisation costs, counted from the pattern alone.
#pragma once

#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

struct FactorOperations {
    long long nonzeros = 0;     // of the factor, diagonal included
    double factorisation = 0;   // multiply–adds of LDLᵀ
    double solve = 0;           // multiply–adds of one solve with one right-hand side: L, D and Lᵀ
};

/// Of LDLᵀ of a symmetric matrix with the pattern of A when row order[i] is eliminated as the i-th. Entries that the library stores on
/// top to work in blocks are not counted.
/// Source: the elimination tree of Davis, Direct Methods for Sparse Linear Systems (2006), §4.1.
/// @throws MeshError if `order` is no permutation of the rows
FactorOperations factor_operations(const SparseMatrix& A, const std::vector<int>& order);

}   // namespace meshfolio
