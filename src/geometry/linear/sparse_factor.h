/// @file
/// One factorisation of a symmetric sparse matrix, many solves. CHOLMOD when the build has it, Eigen otherwise.
#pragma once

#include <memory>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// Whose factorisation. `automatic`: CHOLMOD where the build has it; `eigen` is always there, for comparison.
enum class FactorLibrary { automatic, eigen };

class SparseFactor {
public:
    /// LDLᵀ of a symmetric matrix (lower triangle read), indefinite allowed as long as no pivot vanishes.
    /// @throws SolverError if a pivot is zero, within a few roundings of it, or not finite
    static SparseFactor ldlt(const SparseMatrix& A, FactorLibrary library = FactorLibrary::automatic);
    /// Cholesky LLᵀ, supernodal where that is faster.
    /// @throws SolverError if A is not positive definite
    static SparseFactor cholesky(const SparseMatrix& A, FactorLibrary library = FactorLibrary::automatic);

    SparseFactor(SparseFactor&&) noexcept;
    SparseFactor& operator=(SparseFactor&&) noexcept;
    ~SparseFactor();

    /// Solving from several threads at once is safe.
    Vector solve(const Vector& b) const;
    /// Several right-hand sides together (columns of B).
    DenseMatrix solve(const DenseMatrix& B) const;

    /// Pivots < 0: by Sylvester's law the number of negative eigenvalues of a nearby matrix (LDLᵀ only; 0 after cholesky).
    int negative_pivots() const;
    long long nonzeros() const;   // of the factor, diagonal included

    struct Implementation;

private:
    explicit SparseFactor(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

}   // namespace meshfolio
