#include "geometry/linear/sparse_factor.h"

#include <Eigen/OrderingMethods>
#include <cmath>
#include <limits>
#include <string>

#include "base/at.h"
#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

/// Calls visit(i, j, l_ij) for the entries of L below its diagonal, column by column.
template <class Visit> void for_each_entry(const SparseMatrix& L, const Visit& visit) {
    for (int j = 0; j < L.cols(); ++j)
        for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) visit(entry.row(), Eigen::Index{j}, entry.value());
}

}   // namespace

// Row k of L has an entry in every column on the way up the elimination tree from its own entries to k (Davis, Direct Methods for Sparse
// Linear Systems, §4.1).
FactorOperations factor_operations(const SparseMatrix& S) {
    const auto n = static_cast<std::size_t>(S.rows());
    std::vector<int> parent(n, -1), seen(n, -1), below(n, 0);   // the tree, the last row to visit, entries below the diagonal
    for (int k = 0; k < S.rows(); ++k) {
        seen[at(k)] = k;
        for (SparseMatrix::InnerIterator entry(S, k); entry && entry.row() < k; ++entry) {
            for (auto i = std::size_t(entry.row()); seen[i] != k; i = at(parent[i])) {
                if (parent[i] < 0) parent[i] = k;
                seen[i] = k;
                ++below[i];
            }
        }
    }
    FactorOperations operations;
    for (const double c : below) {
        operations.nonzeros += static_cast<long long>(c) + 1;
        operations.factorisation += 0.5 * c * (c + 1) + c;   // the symmetric update of the rest, and the division by the pivot
        operations.solve += 2 * c + 1;
    }
    return operations;
}

EliminationOrder::EliminationOrder(const SparseMatrix& A) {
    if (A.rows() != A.cols() || A.rows() == 0)
        throw SolverError(
            "LDLᵀ factorisation: a matrix of " + std::to_string(A.rows()) + " × " + std::to_string(A.cols()) + " is empty or not square",
            "give a square matrix with at least one row");
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(A, order);
    row.assign(order.indices().begin(), order.indices().end());
    operations = factor_operations(apply(A));
    constexpr double bytes_per_entry = 12, bytes_per_row = 400;   // row and value; the matrix, its copy and room for elimination
    memory = bytes_per_entry * static_cast<double>(operations.nonzeros) + bytes_per_row * static_cast<double>(A.rows());
}

SparseMatrix in_order(const SparseMatrix& A, const std::vector<int>& row) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> to_row(A.rows());
    std::copy(row.begin(), row.end(), to_row.indices().data());
    SparseMatrix ordered;
    ordered = A.twistedBy(to_row.transpose());
    return ordered;
}

OrderedFactor::OrderedFactor(const SparseMatrix& S, double sigma, Kind kind) {
    if (!Eigen::Map<const Vector>(S.valuePtr(), S.nonZeros()).allFinite() || !std::isfinite(sigma))
        throw SolverError("LDLᵀ factorisation of a " + std::to_string(S.rows()) + "-row matrix: an entry is not finite");
    const auto ldlt = std::make_shared<Ldlt>();
    ldlt->setShift(-sigma);
    ldlt->compute(S);
    if (ldlt->info() != Eigen::Success)
        throw SolverError("LDLᵀ factorisation of a " + std::to_string(S.rows()) + "-row matrix: a pivot is 0");
    D_ = ldlt->vectorD();
    growth_ = 0;
    for (int i = 0; i < size(); ++i) {
        const double diagonal = S.coeff(i, i) - sigma;
        // A pivot is the rest of a diagonal entry after elimination. Below a few roundings of that entry its sign means nothing.
        const bool definite = kind == Kind::definite;
        if (!(std::isfinite(D_[i]) && (definite ? D_[i] : std::abs(D_[i])) > 16 * epsilon * std::abs(diagonal)))
            throw SolverError("LDLᵀ factorisation of a " + std::to_string(S.rows()) + "-row matrix" +
                              (definite ? ", which is not positive definite" : "") + ": pivot " + plain_text(D_[i], 3) + " at step " +
                              std::to_string(i) + " is lost in the rounding of the diagonal, " + plain_text(diagonal, 3));
        growth_ = std::max(growth_, std::abs(D_[i] / diagonal));
    }
    ldlt_ = ldlt;
}

void OrderedFactor::solve_in_place(Eigen::Ref<DenseMatrix> X) const {
    const auto L = ldlt_->matrixL();
    const auto U = ldlt_->matrixU();
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
        auto x = X.col(j);
        L.solveInPlace(x);
        x.array() /= D_.array();
        U.solveInPlace(x);
    }
}

// Each entry of L is read once for all columns.
void OrderedFactor::solve_in_place(FourColumns& X) const {
    const auto lower = ldlt_->matrixL();
    const SparseMatrix& L = lower.nestedExpression();
    const int *const start = L.outerIndexPtr(), *const row = L.innerIndexPtr();
    const double* const value = L.valuePtr();
    for (int j = 0; j < size(); ++j) {
        const Four x = row_of(X, j);
        for (int p = start[j], end = start[j + 1]; p < end; ++p) row_of(X, row[p]) -= value[p] * x;
    }
    for (int j = size() - 1; j >= 0; --j) {
        Four x = row_of(X, j) / D_[j];
        for (int p = start[j], end = start[j + 1]; p < end; ++p) x -= value[p] * row_of(X, row[p]);
        row_of(X, j) = x;
    }
}

double OrderedFactor::backward_error(const Vector& W, int passes) const {
    constexpr double u = epsilon / 2, underflow = std::numeric_limits<double>::min();
    const auto lower = ldlt_->matrixL();
    const SparseMatrix& L = lower.nestedExpression();
    Vector roundings = Vector::Constant(size(), 3.0);   // t_i + 3
    for_each_entry(L, [&](Eigen::Index i, Eigen::Index, double) { roundings[i] += 1; });
    Vector x = Vector::Ones(size());
    double least = infinity;
    for (int pass = 0; pass < passes; ++pass) {
        Vector outer = x;   // |D||Lᵀ|x
        for_each_entry(L, [&](Eigen::Index i, Eigen::Index j, double l) { outer[j] += std::abs(l) * x[i]; });
        outer.array() *= D_.array().abs();
        Vector sizes = outer;   // |L||D||Lᵀ|x
        for_each_entry(L, [&](Eigen::Index i, Eigen::Index j, double l) { sizes[i] += std::abs(l) * outer[j]; });
        const Vector ratio = (roundings.array() * (u * sizes.array() + underflow) / (W.array() * x.array())).matrix();
        if (!ratio.allFinite() || !(ratio.minCoeff() > 0)) break;   // a maximum may pass over a NaN
        const double largest = ratio.maxCoeff();
        least = std::min(least, largest);
        x.array() *= (ratio.array() / largest).sqrt();
    }
    return least;
}

DenseMatrix SparseFactor::solve(const DenseMatrix& B) const {
    if (B.rows() != factor_.size())
        throw SolverError(
            "solve: a right-hand side of " + std::to_string(B.rows()) + " rows for a matrix of " + std::to_string(factor_.size()),
            "give one row for each row of the matrix");
    DenseMatrix ordered = B(order_.row, Eigen::all), X(B.rows(), B.cols());
    factor_.solve_in_place(ordered);
    X(order_.row, Eigen::all) = ordered;
    return X;
}

}   // namespace meshfolio
