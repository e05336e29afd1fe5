#include "geometry/linear/sparse_factor.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <limits>

#include "base/errors.h"
#include "geometry/dense_pairs.h"
#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

SparseMatrix diagonal_matrix(const Vector& d) {
    SparseMatrix D(d.size(), d.size());
    D = d.asDiagonal();
    return D;
}

/// −C − σM of an irregular sphere: definite for σ < 0, with as many negative eigenvalues as −L has below σ.
SparseMatrix shifted_laplacian(double sigma, int level = 2) {
    const LaplaceBeltrami laplacian = laplace_beltrami(irregular_sphere(level));
    return -laplacian.C - diagonal_matrix(sigma * laplacian.M);
}

/// −1 2 −1 of a path of n vertices, plus `shift` on the diagonal.
SparseMatrix path_matrix(int n, double shift) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) entries.emplace_back(i, i, (i == 0 || i == n - 1 ? 1 : 2) + shift);
    for (int i = 1; i < n; ++i) {
        entries.emplace_back(i, i - 1, -1);
        entries.emplace_back(i - 1, i, -1);
    }
    SparseMatrix A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
}

/// The five-point stencil on an n × n grid plus the identity.
SparseMatrix grid_matrix(int n) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n * n; ++i) {
        entries.emplace_back(i, i, 5);
        if (i % n > 0) entries.emplace_back(i, i - 1, -1);
        if (i >= n) entries.emplace_back(i, i - n, -1);
    }
    SparseMatrix A(n * n, n * n);
    A.setFromTriplets(entries.begin(), entries.end());
    return A.selfadjointView<Eigen::Lower>();
}

DenseMatrix some_columns(Eigen::Index rows, Eigen::Index columns) {
    return DenseMatrix::NullaryExpr(rows, columns,
                                    [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + 3.7 * double(i) + 11.3 * double(j)); });
}

double relative_residual(const SparseMatrix& A, const DenseMatrix& X, const DenseMatrix& B) { return (A * X - B).norm() / B.norm(); }

}   // namespace

TEST(SparseFactor, SolvesToRounding) {
    for (const double sigma : {-1.0, 3.0, 40.0}) {
        const SparseMatrix A = shifted_laplacian(sigma);
        const DenseMatrix B = some_columns(A.rows(), 5);
        EXPECT_LT(relative_residual(A, SparseFactor::ldlt(A).solve(B), B), 1e-11) << sigma;
        if (sigma > 0) continue;
        EXPECT_LT(relative_residual(A, SparseFactor::cholesky(A).solve(B), B), 1e-13);
    }
}

TEST(SparseFactor, ColumnsTogetherAreColumnsAlone) {
    const SparseMatrix A = shifted_laplacian(-0.1);
    const DenseMatrix B = some_columns(A.rows(), 7);
    const SparseFactor factor = SparseFactor::cholesky(A);
    const DenseMatrix X = factor.solve(B);
    for (Eigen::Index j = 0; j < B.cols(); ++j) EXPECT_LT((factor.solve(Vector(B.col(j))) - X.col(j)).norm(), 1e-12 * X.col(j).norm());
}

// Sylvester's law of inertia.
TEST(SparseFactor, NegativePivotsAreNegativeEigenvalues) {
    const LaplaceBeltrami laplacian = laplace_beltrami(irregular_sphere(2));
    const Vector mu = dense_pairs(laplacian).eigenvalues;
    for (Eigen::Index k = 1; k < mu.size(); ++k) {
        if (mu[k] - mu[k - 1] < 1e-6 * mu[k]) continue;
        const double sigma = 0.5 * (mu[k - 1] + mu[k]);
        EXPECT_EQ(SparseFactor::ldlt(shifted_laplacian(sigma)).negative_pivots(), k);
    }
}

TEST(SparseFactor, OnlyTheLowerTriangleIsRead) {
    const SparseMatrix A = shifted_laplacian(5);
    const SparseMatrix lower = A.triangularView<Eigen::Lower>();
    const DenseMatrix B = some_columns(A.rows(), 1);
    EXPECT_LT(relative_residual(A, SparseFactor::ldlt(lower).solve(B), B), 1e-11);
}

TEST(SparseFactor, AnUncompressedMatrixIsTheSameMatrix) {
    SparseMatrix A = shifted_laplacian(-1);
    const SparseFactor factor = SparseFactor::cholesky(A);
    const DenseMatrix B = some_columns(A.rows(), 1);
    A.uncompress();
    EXPECT_EQ(SparseFactor::cholesky(A).solve(B), factor.solve(B));
}

TEST(SparseFactor, CholeskyRefusesIndefiniteMatrices) {
    EXPECT_THROW(SparseFactor::cholesky(shifted_laplacian(3)), SolverError);
    EXPECT_THROW(SparseFactor::cholesky(path_matrix(50, -1e-9)), SolverError);
    EXPECT_NO_THROW(SparseFactor::cholesky(path_matrix(50, 1e-9)));
}

TEST(SparseFactor, LdltRefusesSingularMatrices) {
    EXPECT_THROW(SparseFactor::ldlt(path_matrix(50, 0)), SolverError);
    EXPECT_THROW(SparseFactor::ldlt(-laplace_beltrami(icosphere(1)).C), SolverError) << "C1 = 0";
}

TEST(SparseFactor, RefusesMatricesThatCannotBeFactored) {
    SparseMatrix A = path_matrix(5, 1);
    A.coeffRef(2, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(SparseFactor::ldlt(A), SolverError);
    A.coeffRef(2, 2) = std::numeric_limits<double>::infinity();
    EXPECT_THROW(SparseFactor::cholesky(A), SolverError);
    EXPECT_THROW(SparseFactor::ldlt(SparseMatrix(3, 4)), SolverError);
    EXPECT_THROW(SparseFactor::ldlt(SparseMatrix(0, 0)), SolverError);
    EXPECT_THROW(SparseFactor::cholesky(path_matrix(5, 1)).solve(Vector(Vector::Ones(4))), SolverError);
}

// A path has a factor without fill: n diagonal entries and n − 1 below.
TEST(SparseFactor, NonzerosCountDiagonalAndBelow) {
    EXPECT_EQ(SparseFactor::ldlt(path_matrix(40, 1)).nonzeros(), 79);
    EXPECT_EQ(SparseFactor::cholesky(path_matrix(40, 1)).nonzeros(), 79);
    EXPECT_EQ(SparseFactor::cholesky(path_matrix(40, 1)).negative_pivots(), 0);
}

TEST(SparseFactor, LargeCholesky) {
    SparseMatrix A = grid_matrix(320);
    const DenseMatrix B = some_columns(A.rows(), 3);
    const SparseFactor factor = SparseFactor::cholesky(A);
    EXPECT_LT(relative_residual(A, factor.solve(B), B), 1e-14);
    EXPECT_GE(factor.nonzeros(), (A.nonZeros() + A.rows()) / 2);
    A.coeffRef(777, 777) = -5;
    EXPECT_THROW(SparseFactor::cholesky(A), SolverError);
}

TEST(SparseFactor, SolvesFromSeveralThreads) {
    const SparseMatrix A = shifted_laplacian(-1, 3);
    const SparseFactor factor = SparseFactor::cholesky(A);
    const DenseMatrix B = some_columns(A.rows(), 64);
    DenseMatrix X(B.rows(), B.cols());
    tbb::parallel_for(Eigen::Index{0}, B.cols(), [&](Eigen::Index j) { X.col(j) = factor.solve(Vector(B.col(j))); });
    for (Eigen::Index j = 0; j < B.cols(); ++j) EXPECT_EQ(X.col(j), factor.solve(Vector(B.col(j))));
}

TEST(EliminationOrder, CountsTheEntriesOfTheFactor) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), grid_mesh(3, 2, 1, 1), irregular_plane(20)}) {
        const SparseMatrix A = -laplace_beltrami(mesh).C;
        Eigen::SimplicialLDLT<SparseMatrix> eigen(A + diagonal_matrix(Vector::Ones(A.rows())));
        const long long entries = SparseMatrix(eigen.matrixL()).nonZeros();
        EXPECT_EQ(EliminationOrder(A).operations.nonzeros, entries);
    }
    const EliminationOrder full(SparseMatrix(DenseMatrix::Ones(7, 7).sparseView()));
    EXPECT_EQ(full.operations.nonzeros, 7 * 8 / 2);
    EXPECT_EQ(EliminationOrder(path_matrix(50, 0)).operations.nonzeros, 50 + 49);
}

// A column with c entries below its pivot: c divisions and c(c + 1)/2 products; a solve takes 2c + 1.
TEST(FactorOperations, OfABandAndOfAFullMatrix) {
    const FactorOperations path = factor_operations(path_matrix(100, 0));
    EXPECT_EQ(path.factorisation, 99 * 2);
    EXPECT_EQ(path.solve, 99 * 3 + 1);
    constexpr int n = 30;
    const FactorOperations full = factor_operations(SparseMatrix(DenseMatrix::Ones(n, n).sparseView()));
    EXPECT_EQ(full.solve, n * n);
    EXPECT_EQ(full.factorisation, (n - 1) * n * (n + 1) / 6 + n * (n - 1) / 2);
}

TEST(OrderedFactor, SolvesWithEveryShiftInOneOrder) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), grid_mesh(3, 2, 1, 1), irregular_plane(20)}) {
        const SparseMatrix A = -laplace_beltrami(mesh).C;
        const EliminationOrder order(A);
        const SparseMatrix S = order.apply(A);
        for (const double sigma : {-1.0, 0.3, 2.7}) {
            const OrderedFactor factor(S, sigma, OrderedFactor::Kind::indefinite);
            const DenseMatrix B = some_columns(S.rows(), 3);
            DenseMatrix X = B;
            factor.solve_in_place(X);
            EXPECT_LT((S * X - sigma * X - B).norm(), 1e-10 * X.norm()) << sigma;
            FourColumns rows(S.rows(), 4);
            for (Eigen::Index i = 0; i < S.rows(); ++i)
                for (Eigen::Index c = 0; c < 4; ++c) rows.row(i)[c] = c < 3 ? B(i, c) : 0;
            factor.solve_in_place(rows);
            for (Eigen::Index i = 0; i < S.rows(); ++i)
                for (Eigen::Index c = 0; c < 3; ++c) EXPECT_NEAR(rows.row(i)[c], X(i, c), 1e-10 * X.norm());
            EXPECT_EQ(factor.negative_pivots(),
                      SparseFactor::ldlt(A - diagonal_matrix(Vector::Constant(A.rows(), sigma))).negative_pivots());
            EXPECT_LT(factor.backward_error(Vector::Ones(S.rows()), 1), 1e-8);
            EXPECT_LE(factor.backward_error(Vector::Ones(S.rows()), 2), factor.backward_error(Vector::Ones(S.rows()), 1));
        }
    }
}

TEST(OrderedFactor, AShiftOnAnEigenvalueIsRefused) {
    const SparseMatrix D = diagonal_matrix(Vector::LinSpaced(4, 1, 4));
    EXPECT_EQ(OrderedFactor(D, 2.5, OrderedFactor::Kind::indefinite).negative_pivots(), 2);
    EXPECT_THROW(OrderedFactor(D, 2, OrderedFactor::Kind::indefinite), SolverError);
    EXPECT_THROW(OrderedFactor(D, 2.5, OrderedFactor::Kind::definite), SolverError);
}
