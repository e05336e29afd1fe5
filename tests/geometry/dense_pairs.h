/// @file
/// Eigenpairs by Eigen's dense solver, what faster ones are held against. Compiled once: the solver takes five seconds a source.
#pragma once

#include "geometry/operators/cotangent_laplacian.h"

namespace meshfolio::testing {

struct DensePairs {
    Vector eigenvalues;         // all n, ascending
    DenseMatrix eigenvectors;   // n × n
};

/// Ax = μx, vectors of length 1. A: symmetric.
DensePairs dense_pairs(const DenseMatrix& A);

/// Ax = μMx, XᵀMX = I. A: symmetric, M: the diagonal, positive.
DensePairs dense_pairs(const DenseMatrix& A, const Vector& M);

/// −Cφ = μMφ, ΦᵀMΦ = I.
DensePairs dense_pairs(const LaplaceBeltrami& laplacian);

}   // namespace meshfolio::testing
