#include "geometry/diffusion_step.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <string>
#include <utility>

#include "errors.h"

namespace meshfolio {

/// A is symmetric, so its column j is row j.
ExplicitDiffusion::ExplicitDiffusion(const OperatorWithMass& whole) : L_(whole.all_vertices, whole.all_vertices) {
    L_.reserve(whole.A.nonZeros());
    int next_row = 0;
    for (int j = 0; j < whole.size(); ++j) {
        const int row = whole.vertex[static_cast<std::size_t>(j)];
        while (next_row <= row) L_.startVec(next_row++);
        for (SparseMatrix::InnerIterator entry(whole.A, j); entry; ++entry) {
            L_.insertBack(row, whole.vertex[static_cast<std::size_t>(entry.row())]) = -entry.value() / whole.M[j];
        }
    }
    L_.finalize();
}

Positions ExplicitDiffusion::step(double lambda, const Positions& X) const {
    constexpr Eigen::Index rows_a_task = 4096;
    Positions result(X.rows(), 3);
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, X.rows(), rows_a_task), [&](const tbb::blocked_range<Eigen::Index>& rows) {
        for (Eigen::Index i = rows.begin(); i < rows.end(); ++i) {
            Eigen::RowVector3d LX = Eigen::RowVector3d::Zero();
            for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(L_, i); entry; ++entry) {
                LX += entry.value() * X.row(entry.col());
            }
            result.row(i) = X.row(i) + lambda * LX;
        }
    });
    return result;
}

void ImplicitDiffusion::prepare(OperatorWithMass whole, double lambda) {
    const bool same_vertices = factor_ && whole.vertex == whole_.vertex;
    whole_ = std::move(whole);
    SparseMatrix mass(whole_.A.rows(), whole_.A.cols());
    mass = whole_.M.asDiagonal();
    const SparseMatrix system = mass + lambda * whole_.A;
    try {
        if (same_vertices) {
            factor_->refactor(system);
        } else {
            factor_ = SparseFactor::cholesky(system);
        }
    } catch (const SolverError& error) {
        throw SolverError("M − λC cannot be factored at this lambda: " + std::string(error.what()),
                          "take a smaller lambda, or repair triangles of zero area");
    }
}

Positions ImplicitDiffusion::step(const Positions& X) const {
    const DenseMatrix right = whole_.M.asDiagonal() * DenseMatrix(X(whole_.vertex, Eigen::all));
    Positions result = X;
    result(whole_.vertex, Eigen::all) = factor_->solve(right);
    return result;
}

}   // namespace meshfolio
