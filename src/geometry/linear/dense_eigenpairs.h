/// @file
/// Eigenpairs of small dense symmetric matrices: Eigen's solver, compiled once.
#pragma once

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

struct DenseEigenpairs {
    Vector values;         // ascending
    DenseMatrix vectors;   // orthonormal, a column a value
};

/// @param A  whose lower triangle is read
/// @throws SolverError if they do not converge
DenseEigenpairs dense_eigenpairs(const DenseMatrix& A);

/// Of the symmetric tridiagonal matrix with these n diagonal entries and n − 1 beside them. @throws SolverError as above
DenseEigenpairs tridiagonal_eigenpairs(const Vector& diagonal, const Vector& beside);

}   // namespace meshfolio
