#include "geometry/linear/subtree_solves.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "geometry/linear/ldlt_analysis.h"
#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// Blocks of A beside each other.
SparseMatrix repeated(const SparseMatrix& A, int times) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int t = 0; t < times; ++t)
        for (int j = 0; j < A.cols(); ++j)
            for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry)
                entries.emplace_back(t * A.rows() + entry.row(), t * A.rows() + j, entry.value());
    SparseMatrix all(times * A.rows(), times * A.rows());
    all.setFromTriplets(entries.begin(), entries.end());
    return all;
}

}   // namespace

// Many subtrees; forests, of which a tree may be a subtree as a whole; one front; a single row.
TEST(SubtreeSolves, SolveAsTheWholeForAnyNumberOfThreads) {
    const SparseMatrix sphere = -laplace_beltrami(irregular_sphere(5)).C, small = -laplace_beltrami(irregular_sphere(2)).C;
    const DenseMatrix square = DenseMatrix::Random(300, 300);
    for (const SparseMatrix& A : {sphere, repeated(small, 3), repeated(small, 40), SparseMatrix((square + square.transpose()).sparseView()),
                                  SparseMatrix(DenseMatrix::Ones(1, 1).sparseView())}) {
        const LdltPanels factor = LdltAnalysis(A).factor(A, 0.3);
        const SubtreeSolves subtrees(factor);
        const DenseMatrix random = DenseMatrix::Random(8, A.rows());
        EightColumns whole(A.rows()), first(A.rows());
        for (EightColumns* X : {&whole, &first}) std::copy_n(random.data(), random.size(), X->data());
        solve_in_place(factor, whole.data());
        subtrees.solve_in_place(first.data());
        const auto numbers = [&](const EightColumns& X) { return Eigen::Map<const DenseMatrix>(X.data(), 8, A.rows()); };
        EXPECT_LT((numbers(whole) - numbers(first)).cwiseAbs().maxCoeff(), 1e-10 * numbers(whole).cwiseAbs().maxCoeff()) << A.rows();
        for (const std::size_t threads : {1u, 2u, 5u}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            EightColumns X(A.rows());
            std::copy_n(random.data(), random.size(), X.data());
            subtrees.solve_in_place(X.data());
            EXPECT_EQ(numbers(X), numbers(first)) << A.rows();
        }
    }
}
