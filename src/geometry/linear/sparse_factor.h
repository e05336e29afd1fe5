/// @file
/// One factorisation of a symmetric sparse matrix, many solves.
#pragma once

#include "geometry/linear/ldlt_panels.h"

namespace meshfolio {

class SparseFactor {
public:
    /// LDLᵀ of a symmetric matrix (lower triangle read, every diagonal entry stored), indefinite allowed as long as no pivot vanishes.
    /// @throws SolverError if a pivot is zero, within a few roundings of it, or not finite
    static SparseFactor ldlt(const SparseMatrix& A);
    /// The same with D > 0, Cholesky's factor.
    /// @throws SolverError if A is not positive definite
    static SparseFactor cholesky(const SparseMatrix& A);

    /// Solving from several threads at once is safe. B: a row for each of A; its columns are solved together.
    DenseMatrix solve(const DenseMatrix& B) const;
    Vector solve(const Vector& b) const { return solve(DenseMatrix(b)).col(0); }

    /// Pivots < 0: by Sylvester's law the number of negative eigenvalues of a nearby matrix.
    int negative_pivots() const { return panels_.negative_pivots(); }
    long long nonzeros() const { return nonzeros_; }   // of the factor, diagonal included
    /// δ with |xᵀEx| ≤ δ xᵀWx for all x, where the factor is exactly that of A + E (ldlt_panels.h).
    double backward_error(const Vector& W) const;

private:
    SparseFactor(const SparseMatrix& A, bool definite);

    LdltPanels panels_;
    long long nonzeros_;
};

}   // namespace meshfolio
