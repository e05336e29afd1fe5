#include "geometry/linear/factor_operations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/errors.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/implicit_solver.h"
#include "geometry/solver_test_meshes.h"
#include "mesh/samples/sample_shapes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

std::vector<int> natural_order(int n) {
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    return order;
}

SparseMatrix with_pattern(const DenseMatrix& dense) { return dense.sparseView(); }

/// Multiply–adds of LDLᵀ by elimination on the dense pattern, counted one by one.
FactorOperations by_elimination(DenseMatrix A) {
    FactorOperations counted;
    const Eigen::Index n = A.rows();
    for (Eigen::Index k = 0; k < n; ++k) {
        ++counted.nonzeros;
        counted.solve += 1;
        for (Eigen::Index i = k + 1; i < n; ++i) {
            if (A(i, k) == 0) continue;
            ++counted.nonzeros;
            counted.solve += 2;
            counted.factorisation += 1;   // by the pivot
            for (Eigen::Index j = k + 1; j <= i; ++j) {
                if (A(j, k) == 0) continue;
                counted.factorisation += 1;
                A(i, j) = A(j, i) = 1;
            }
        }
    }
    return counted;
}

}   // namespace

TEST(FactorOperations, AreThoseOfEliminationStepByStep) {
    for (const TriangleMesh& mesh : {icosphere(1), irregular_plane(6), cube_mesh(3)}) {
        const SparseMatrix A = operator_with_mass(laplace_beltrami(mesh)).A;
        DenseMatrix pattern = DenseMatrix::Zero(A.rows(), A.cols());
        for (Eigen::Index j = 0; j < A.cols(); ++j) {
            for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) pattern(entry.row(), j) = 1;
        }
        const FactorOperations counted = factor_operations(A, natural_order(int(A.rows()))), expected = by_elimination(pattern);
        EXPECT_EQ(counted.nonzeros, expected.nonzeros);
        EXPECT_EQ(counted.factorisation, expected.factorisation);
        EXPECT_EQ(counted.solve, expected.solve);
    }
}

TEST(FactorOperations, OfABandAndOfAFullMatrix) {
    const int n = 20;
    DenseMatrix band = DenseMatrix::Zero(n, n);
    band.diagonal(0).setOnes();
    band.diagonal(1).setOnes();
    band.diagonal(-1).setOnes();
    const FactorOperations narrow = factor_operations(with_pattern(band), natural_order(n));
    EXPECT_EQ(narrow.nonzeros, 2 * n - 1);
    EXPECT_EQ(narrow.factorisation, 2 * (n - 1));
    const FactorOperations full = factor_operations(with_pattern(DenseMatrix::Ones(n, n)), natural_order(n));
    EXPECT_EQ(full.nonzeros, n * (n + 1) / 2);
    EXPECT_EQ(full.solve, n * n);
}

// An arrow that points up fills everything when its head is eliminated first, and nothing when it is last.
TEST(FactorOperations, TheOrderDecides) {
    const int n = 12;
    DenseMatrix arrow = DenseMatrix::Identity(n, n);
    arrow.row(0).setOnes();
    arrow.col(0).setOnes();
    std::vector<int> reversed = natural_order(n);
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_EQ(factor_operations(with_pattern(arrow), natural_order(n)).nonzeros, n * (n + 1) / 2);
    EXPECT_EQ(factor_operations(with_pattern(arrow), reversed).nonzeros, 2 * n - 1);
}

TEST(FactorOperations, CountTheEntriesThatTheSolverHas) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), irregular_plane(20)}) {
        const OperatorWithMass whole = operator_with_mass(laplace_beltrami(mesh));
        ImplicitSolver solver;
        solver.prepare(whole, 1, mesh.X);
        EXPECT_EQ(factor_operations(whole.A, solver.vertex()).nonzeros, solver.factor_nonzeros());
    }
}

TEST(FactorOperations, RefuseWhatIsNoOrder) {
    const SparseMatrix A = with_pattern(DenseMatrix::Identity(3, 3));
    EXPECT_THROW(factor_operations(A, {0, 1}), MeshError);
    EXPECT_THROW(factor_operations(A, {0, 1, 1}), MeshError);
    EXPECT_THROW(factor_operations(A, {0, 1, 3}), MeshError);
}
