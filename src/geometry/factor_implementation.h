/// @file
/// What a factorisation library must do for SparseFactor. Private to the layer.
#pragma once

#include <vector>

#include "geometry/sparse_factor.h"

namespace meshfolio {

enum class FactorKind { ldlt, cholesky };

struct SparseFactor::Implementation {
    virtual ~Implementation() = default;
    virtual void analyze(const SparseMatrix& A) = 0;
    /// Numerical factorisation after `analyze`; false if the library gave up (a zero pivot, not positive definite).
    virtual bool factorize(const SparseMatrix& A) = 0;
    virtual DenseMatrix solve(const DenseMatrix& B) const = 0;
    /// Pivot belonging to each row of A: D of LDLᵀ, or the squared diagonal of the Cholesky factor.
    virtual Vector pivots() const = 0;
    virtual long long nonzeros() const = 0;

    FactorKind kind = FactorKind::ldlt;
    Eigen::Index rows = 0;
    std::vector<int> pattern;   // of the matrix analysed: column starts, then rows
    int negative = 0;           // pivots < 0
};

std::unique_ptr<SparseFactor::Implementation> factor_by_eigen(FactorKind kind);
#ifdef MESHFOLIO_WITH_CHOLMOD
std::unique_ptr<SparseFactor::Implementation> factor_by_cholmod(FactorKind kind);
#endif

}   // namespace meshfolio
