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

/// Computes those of the symmetric tridiagonal matrix with these n diagonal entries and n − 1 beside them.
/// @throws SolverError if they do not converge
DenseEigenpairs tridiagonal_eigenpairs(const Vector& diagonal, const Vector& beside);

}   // namespace meshfolio
