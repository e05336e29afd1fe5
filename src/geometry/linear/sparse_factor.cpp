#include "geometry/linear/sparse_factor.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/linear/factor_implementation.h"

namespace meshfolio {

namespace {

using Implementation = SparseFactor::Implementation;

std::string name_of(FactorKind kind) { return kind == FactorKind::ldlt ? "LDLᵀ factorisation" : "Cholesky factorisation"; }

SparseMatrix compressed(SparseMatrix A) {
    A.makeCompressed();
    return A;
}

}   // namespace

void check_finite(const SparseMatrix& A, FactorKind kind) {
    for (Eigen::Index z = 0; z < A.nonZeros(); ++z) {
        if (!std::isfinite(A.valuePtr()[z])) throw SolverError(name_of(kind) + ": the matrix has an entry that is not finite");
    }
}

void check_pivots(const Vector& pivots, const Vector& diagonal, FactorKind kind) {
    for (Eigen::Index i = 0; i < pivots.size(); ++i) {
        const double rounding = 16 * std::numeric_limits<double>::epsilon() * std::abs(diagonal[i]);
        const double d = pivots[i];
        if (std::isfinite(d) && (kind == FactorKind::cholesky ? d > 0 : std::abs(d) > rounding)) continue;
        throw SolverError(name_of(kind) + " of a " + std::to_string(pivots.size()) + "-row matrix: pivot " + plain_text(d, 3) + " at row " +
                          std::to_string(i) + ", where the diagonal is " + plain_text(diagonal[i], 3));
    }
}

void factorize_checked(Implementation& factor, const SparseMatrix& A) {
    check_finite(A, factor.kind);
    if (!factor.factorize(A)) {
        throw SolverError(name_of(factor.kind) + " of a " + std::to_string(A.rows()) + "-row matrix failed: it is " +
                          (factor.kind == FactorKind::ldlt ? "singular" : "not positive definite"));
    }
    const Vector pivots = factor.pivots();
    check_pivots(pivots, A.diagonal(), factor.kind);
    factor.negative = static_cast<int>((pivots.array() < 0).count());
}

std::unique_ptr<Implementation> analysed(const SparseMatrix& A, FactorKind kind, FactorLibrary library) {
    return analysed(A, kind, library, kind == FactorKind::cholesky && A.rows() >= supernodal_from);
}

std::unique_ptr<Implementation> analysed(const SparseMatrix& A, FactorKind kind, FactorLibrary library, bool supernodal) {
#ifdef MESHFOLIO_WITH_CHOLMOD
    auto factor = library == FactorLibrary::eigen ? factor_by_eigen(kind) : factor_by_cholmod(kind);
#else
    static_cast<void>(library);
    auto factor = factor_by_eigen(kind);
#endif
    factor->kind = kind;
    factor->rows = A.rows();
    factor->supernodal = supernodal;
    factor->analyze(A);
    return factor;
}

namespace {

std::unique_ptr<Implementation> factored(const SparseMatrix& A, FactorKind kind, FactorLibrary library) {
    if (A.rows() != A.cols() || A.rows() == 0) throw SolverError(name_of(kind) + ": the matrix is empty or not square");
    if (!A.isCompressed()) return factored(compressed(A), kind, library);
    auto factor = analysed(A, kind, library);
    factorize_checked(*factor, A);
    return factor;
}

}   // namespace

SparseFactor::SparseFactor(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;
SparseFactor& SparseFactor::operator=(SparseFactor&&) noexcept = default;
SparseFactor::~SparseFactor() = default;

SparseFactor SparseFactor::ldlt(const SparseMatrix& A, FactorLibrary library) {
    return SparseFactor(factored(A, FactorKind::ldlt, library));
}

SparseFactor SparseFactor::cholesky(const SparseMatrix& A, FactorLibrary library) {
    return SparseFactor(factored(A, FactorKind::cholesky, library));
}

Vector SparseFactor::solve(const Vector& b) const { return solve(DenseMatrix(b)).col(0); }

DenseMatrix SparseFactor::solve(const DenseMatrix& B) const {
    const Eigen::Index n = implementation_->rows;
    if (B.rows() != n) throw SolverError("solve: " + std::to_string(B.rows()) + " rows for a " + std::to_string(n) + "-row matrix");
    return implementation_->solve(B);
}

int SparseFactor::negative_pivots() const { return implementation_->kind == FactorKind::ldlt ? implementation_->negative : 0; }

long long SparseFactor::nonzeros() const { return implementation_->nonzeros(); }

}   // namespace meshfolio
