/// @file
/// One factorisation of a symmetric sparse matrix, many solves. CHOLMOD when the build has it, Eigen otherwise.
#pragma once

#include <memory>

#include "geometry/sparse_types.h"

namespace meshfolio {

class SparseFactor {
public:
    /// LDLᵀ of a symmetric matrix (lower triangle read), indefinite allowed as long as no pivot vanishes.
    /// @throws SolverError if a pivot is zero or not finite
    static SparseFactor ldlt(const SparseMatrix& A);
    /// Cholesky LLᵀ, supernodal where that is faster.
    /// @throws SolverError if A is not positive definite
    static SparseFactor cholesky(const SparseMatrix& A);

    SparseFactor(SparseFactor&&) noexcept;
    SparseFactor& operator=(SparseFactor&&) noexcept;
    ~SparseFactor();

    /// Refactors another matrix of the same pattern, reusing the symbolic analysis.
    void refactor(const SparseMatrix& A);

    Vector solve(const Vector& b) const;
    /// Several right-hand sides together (columns of B).
    DenseMatrix solve(const DenseMatrix& B) const;

    /// Pivots < 0: by Sylvester's law the number of negative eigenvalues (LDLᵀ only; 0 after cholesky).
    int negative_pivots() const;
    long long nonzeros() const;   // of the factor

private:
    struct Implementation;
    explicit SparseFactor(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

}   // namespace meshfolio
