#include "geometry/linear/ldlt_analysis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/linear/panel_kernels.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/smoothing/diffusion_step.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

EightColumns random_columns(Eigen::Index rows) {
    EightColumns X(rows);
    const DenseMatrix random = DenseMatrix::Random(8, rows);
    std::copy_n(random.data(), 8 * rows, X.data());
    return X;
}

DenseMatrix dense(const EightColumns& X) { return Eigen::Map<const DenseMatrix>(X.data(), 8, X.rows()).transpose(); }

SparseMatrix system_of(const TriangleMesh& mesh, double lambda) {
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    SparseMatrix mass(laplacian.M.size(), laplacian.M.size());
    mass = laplacian.M.asDiagonal();
    return mass - lambda * laplacian.C;
}

/// Largest entry of A X − B over that of B.
double residual_of(const SparseMatrix& A, const LdltPanels& factor) {
    Positions B(A.rows(), 3);
    for (Eigen::Index i = 0; i < B.size(); ++i) B.data()[i] = std::sin(double(i));
    FourColumns rows = gathered(B, factor.order);
    solve_in_place(factor, rows);
    Positions X = B;
    scatter(rows, factor.order, X);
    return (A * X - B).cwiseAbs().maxCoeff() / B.cwiseAbs().maxCoeff();
}

}   // namespace

TEST(LdltAnalysis, SolvesWithEveryShiftOfOneAnalysis) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), grid_mesh(3, 2, 1, 1), irregular_plane(20)}) {
        const SparseMatrix A = -laplace_beltrami(mesh).C;
        const LdltAnalysis analysis(A);
        SparseMatrix identity(A.rows(), A.cols());
        identity.setIdentity();
        for (const double sigma : {-1.0, 0.3, 2.7}) {
            const LdltPanels factor = analysis.factor(A, sigma);
            EightColumns X = random_columns(A.rows());
            const DenseMatrix B = dense(X);
            solve_in_place(factor, X.data());
            DenseMatrix in_order(A.rows(), 8), right(A.rows(), 8);
            for (Eigen::Index i = 0; i < A.rows(); ++i) {
                in_order.row(factor.order[std::size_t(i)]) = dense(X).row(i);
                right.row(factor.order[std::size_t(i)]) = B.row(i);
            }
            const DenseMatrix rest = A * in_order - sigma * in_order - right;
            EXPECT_LT(rest.norm(), 1e-10 * in_order.norm()) << sigma;
            EXPECT_EQ(factor.negative_pivots(), SparseFactor::ldlt(A - sigma * identity).negative_pivots());
            EXPECT_EQ(analysis.count_below(A, sigma).below, factor.negative_pivots());
            EXPECT_EQ(analysis.count_below(A, sigma).delta, shifted_backward_error(factor, sigma));
            EXPECT_LT(shifted_backward_error(factor, sigma), 1e-8);
            EXPECT_GE(factor.growth, 0.5);
        }
    }
}

TEST(LdltAnalysis, AShiftOnAnEigenvalueIsRefused) {
    SparseMatrix A(4, 4);
    A.insert(0, 0) = 1;
    A.insert(1, 1) = 2;
    A.insert(2, 2) = 3;
    A.insert(3, 3) = 4;
    A.makeCompressed();
    const LdltAnalysis analysis(A);
    EXPECT_EQ(analysis.count_below(A, 2.5).below, 2);
    EXPECT_THROW(analysis.factor(A, 2), SolverError);
}

TEST(LdltAnalysis, ServesAllDefiniteMatricesOfItsPattern) {
    for (const TriangleMesh& mesh : {irregular_sphere(4), grid_mesh(3, 2, 1, 1), irregular_plane(20)}) {
        const double step = critical_step(mesh);
        const SparseMatrix first = system_of(mesh, step), second = system_of(mesh, 100 * step);
        const LdltAnalysis analysis(first);
        for (const SparseMatrix& A : {first, second, first}) EXPECT_LT(residual_of(A, analysis.factor_definite(A)), 1e-11);
        EXPECT_THROW(analysis.factor_definite(system_of(mesh, -step)), SolverError);
    }
}

TEST(LdltAnalysis, ThreadsDoNotChangeABitOfALargeFactor) {
    const SparseMatrix A = system_of(irregular_plane(150), 1);
    const LdltAnalysis analysis(A);
    const LdltPanels alone = analysis.factor_definite(A), shared = analysis.factor_definite(A, true);
    EXPECT_EQ(alone.values, shared.values);
    EXPECT_EQ(alone.pivots, shared.pivots);
    EXPECT_GE(analysis.entries(), analysis.nonzeros());
}

TEST(LdltPanels, HoldFullPanelsOfADenseMatrix) {
    const DenseMatrix square = DenseMatrix::Random(21, 21);
    const SparseMatrix A = (square * square.transpose() + DenseMatrix::Identity(21, 21)).sparseView();
    const LdltPanels factor = LdltAnalysis(A).factor(A, 0);
    EXPECT_EQ(factor.first, (std::vector<int>{0, 8, 16, 21}));
    EXPECT_EQ(factor.rows.size(), 13u + 5u);
}

TEST(PanelKernels, AreProductsAndCombinations) {
    constexpr Eigen::Index rows = 3 * panel_rows + 5;
    const EightColumns V = random_columns(rows), U = random_columns(rows);
    EightColumns W = random_columns(rows);
    const std::vector<const double*> blocks{V.data(), U.data()};
    EightColumns G(16);
    std::fill_n(G.data(), 128, 0.0);
    add_products(blocks, W.data(), 7, rows - 2, G.data());
    const auto part = [&](const EightColumns& X) { return DenseMatrix(dense(X).middleRows(7, rows - 9)); };
    DenseMatrix expected(16, 8);
    expected << part(V).transpose() * part(W), part(U).transpose() * part(W);
    EXPECT_LT((dense(G) - expected).cwiseAbs().maxCoeff(), 1e-12);
    DenseMatrix after = dense(W);
    after.middleRows(7, rows - 9) -= part(V) * expected.topRows(8) + part(U) * expected.bottomRows(8);
    subtract_combination(blocks, G.data(), 7, rows - 2, W.data());
    EXPECT_LT((dense(W) - after).cwiseAbs().maxCoeff(), 1e-11);
}
