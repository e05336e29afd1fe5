#include "geometry/linear/front_tree.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/OrderingMethods>

#include "geometry/linear/panel_kernels.h"
#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

std::vector<int> sparse_order(const SparseMatrix& A) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(A, order);
    return {order.indices().data(), order.indices().data() + A.rows()};
}

/// Fronts of every kind: narrow and wide, with and without rows below, dense alone.
std::vector<SparseMatrix> matrices_of_fronts() {
    std::vector<SparseMatrix> all;
    for (const TriangleMesh& mesh : {irregular_sphere(3), grid_mesh(3, 2, 1, 1), irregular_plane(20)})
        all.push_back(-laplace_beltrami(mesh).C);
    const DenseMatrix square = DenseMatrix::Random(45, 45);
    all.push_back((square + square.transpose()).sparseView());
    all.push_back(DenseMatrix(Vector::LinSpaced(5, 1, 5).asDiagonal()).sparseView());
    return all;
}

/// L with its unit diagonal.
DenseMatrix lower_of(const LdltPanels& factor) {
    DenseMatrix L = DenseMatrix::Identity(factor.size, factor.size);
    for (std::size_t p = 0; p < std::size_t(factor.panels()); ++p) {
        const int first = factor.first[p], w = factor.first[p + 1] - first;
        const double* value = factor.values.data() + factor.value_start[p];
        for (int r = 0; r < w; ++r, value += w) {
            for (int c = 0; c < r; ++c) L(first + r, first + c) = value[c];
        }
        for (std::size_t q = factor.row_start[p]; q < factor.row_start[p + 1]; ++q, value += w) {
            for (int c = 0; c < w; ++c) L(factor.rows[q], first + c) = value[c];
        }
    }
    return L;
}

}   // namespace

TEST(FrontElimination, MultipliedOutIsTheMatrix) {
    for (const SparseMatrix& A : matrices_of_fronts()) {
        const FrontTree tree = front_tree(A, sparse_order(A));
        for (const double sigma : {-0.7, 0.31}) {
            const LdltPanels factor = factor_by_fronts(A, sigma, tree, false);
            const DenseMatrix L = lower_of(factor), product = L * factor.pivots.asDiagonal() * L.transpose();
            const DenseMatrix sizes = L.cwiseAbs() * factor.pivots.cwiseAbs().asDiagonal() * L.cwiseAbs().transpose();
            const DenseMatrix dense = DenseMatrix(A) - sigma * DenseMatrix::Identity(A.rows(), A.cols());
            const DenseMatrix in_order = dense(factor.order, factor.order);
            EXPECT_LT((product - in_order).cwiseAbs().cwiseQuotient((sizes.array() + 1e-300).matrix()).maxCoeff(), 1e-14) << sigma;
        }
    }
}

// Many subtrees; one front whose columns are shared out.
TEST(FrontElimination, ThreadsChangeNoBit) {
    const DenseMatrix square = DenseMatrix::Random(1200, 1200);
    for (const SparseMatrix& A :
         {SparseMatrix(-laplace_beltrami(irregular_sphere(5)).C), SparseMatrix((square + square.transpose()).sparseView())}) {
        const FrontTree tree = front_tree(A, sparse_order(A));
        const LdltPanels alone = factor_by_fronts(A, 0.3, tree, false);
        for (const std::size_t threads : {1u, 2u, 5u}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            const LdltPanels shared = factor_by_fronts(A, 0.3, tree, true);
            EXPECT_EQ(shared.values, alone.values);
            EXPECT_EQ(shared.pivots, alone.pivots);
        }
    }
}
