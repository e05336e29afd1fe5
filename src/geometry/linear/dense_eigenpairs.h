/// @file
/// Eigenpairs of small dense symmetric matrices by Eigen's solver, compiled once.
#pragma once

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

struct DenseEigenpairs {
    Vector values;         // ascending
    DenseMatrix vectors;   // orthonormal; column j belongs to values[j]
};

/// Computes all eigenpairs of A, from its lower triangle.
/// @throws SolverError if they do not converge
DenseEigenpairs dense_eigenpairs(const DenseMatrix& A);

}   // namespace meshfolio
