#include "geometry/linear/ldlt_analysis.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "geometry/linear/panel_kernels.h"
#include "geometry/solver_test_meshes.h"

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

class LdltOfEachLibrary : public ::testing::TestWithParam<FactorLibrary> {};

}   // namespace

INSTANTIATE_TEST_SUITE_P(LdltAnalysis, LdltOfEachLibrary, ::testing::Values(FactorLibrary::automatic, FactorLibrary::eigen));

TEST_P(LdltOfEachLibrary, SolvesWithEveryShiftOfOneAnalysis) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), grid_mesh(3, 2, 1, 1), irregular_plane(20)}) {
        const SparseMatrix A = -laplace_beltrami(mesh).C;
        const LdltAnalysis analysis(A, GetParam());
        SparseMatrix identity(A.rows(), A.cols());
        identity.setIdentity();
        for (const double sigma : {-1.0, 0.3, 2.7}) {
            const LdltPanels factor = analysis.factor(sigma);
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
            EXPECT_EQ(analysis.count_below(sigma).below, factor.negative_pivots());
            EXPECT_EQ(analysis.count_below(sigma).delta, factor.delta);
            EXPECT_LT(factor.delta, 1e-8);
            EXPECT_GE(factor.growth, 0.5);
        }
    }
}

TEST_P(LdltOfEachLibrary, AShiftOnAnEigenvalueIsRefused) {
    SparseMatrix A(4, 4);
    A.insert(0, 0) = 1;
    A.insert(1, 1) = 2;
    A.insert(2, 2) = 3;
    A.insert(3, 3) = 4;
    A.makeCompressed();
    const LdltAnalysis analysis(A, GetParam());
    EXPECT_EQ(analysis.count_below(2.5).below, 2);
    EXPECT_THROW(analysis.factor(2), SolverError);
}

TEST(LdltPanels, HoldFullPanelsOfADenseMatrix) {
    const DenseMatrix square = DenseMatrix::Random(21, 21);
    const SparseMatrix A = (square * square.transpose() + DenseMatrix::Identity(21, 21)).sparseView();
    const LdltPanels factor = LdltAnalysis(A).factor(0);
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
