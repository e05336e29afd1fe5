#include "geometry/linear/sparse_factor.h"

#include <algorithm>
#include <string>

#include "base/errors.h"
#include "geometry/linear/ldlt_analysis.h"
#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/panel_kernels.h"

namespace meshfolio {

SparseFactor::SparseFactor(const SparseMatrix& A, bool definite) {
    if (A.rows() != A.cols()) throw SolverError("LDLᵀ factorisation: the matrix is not square");
    const SparseMatrix whole = A.selfadjointView<Eigen::Lower>();
    const LdltAnalysis analysis(whole);
    panels_ = definite ? analysis.factor_definite(whole, true) : analysis.factor(whole, 0, true);
    nonzeros_ = analysis.nonzeros();
}

SparseFactor SparseFactor::ldlt(const SparseMatrix& A) { return {A, false}; }

SparseFactor SparseFactor::cholesky(const SparseMatrix& A) { return {A, true}; }

DenseMatrix SparseFactor::solve(const DenseMatrix& B) const {
    constexpr Eigen::Index width = FourColumns::width;
    if (B.rows() != panels_.size)
        throw SolverError("solve: " + std::to_string(B.rows()) + " rows for a " + std::to_string(panels_.size) + "-row matrix");
    DenseMatrix X(B.rows(), B.cols());
    for (Eigen::Index first = 0; first < B.cols(); first += width) {
        const Eigen::Index columns = std::min(width, B.cols() - first);
        FourColumns four(B.rows());
        for (Eigen::Index i = 0; i < B.rows(); ++i)
            for (Eigen::Index c = 0; c < width; ++c) four.row(i)[c] = c < columns ? B(panels_.order[std::size_t(i)], first + c) : 0;
        solve_in_place(panels_, four);
        for (Eigen::Index i = 0; i < B.rows(); ++i)
            for (Eigen::Index c = 0; c < columns; ++c) X(panels_.order[std::size_t(i)], first + c) = four.row(i)[c];
    }
    return X;
}

double SparseFactor::backward_error(const Vector& W) const { return meshfolio::backward_error(panels_, W); }

}   // namespace meshfolio
