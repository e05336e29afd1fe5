#include "geometry/linear/front_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "geometry/linear/factor_operations.h"
#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

std::vector<SparseMatrix> matrices_of_trees() {
    std::vector<SparseMatrix> all;
    for (const TriangleMesh& mesh : {irregular_sphere(3), grid_mesh(3, 2, 1, 1), irregular_plane(20)})
        all.push_back(-laplace_beltrami(mesh).C);
    all.push_back(DenseMatrix::Ones(21, 21).sparseView());
    all.push_back(DenseMatrix::Identity(5, 5).sparseView());   // a forest of single columns
    return all;
}

/// One that leaves much fill and many kinds of trees.
std::vector<int> some_order(Eigen::Index n) {
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [](int a, int b) { return a * 7 % 5 < b * 7 % 5; });
    return order;
}

}   // namespace

TEST(FrontTree, IsAPostorder) {
    for (const SparseMatrix& A : matrices_of_trees()) {
        const FrontTree tree = front_tree(A, some_order(A.rows()));
        std::vector<int> first(std::size_t(tree.fronts()));   // front of each subtree
        std::vector<int> size(first.size(), 1);
        for (int f = 0; f < tree.fronts(); ++f) {
            const int parent = tree.parent[std::size_t(f)];
            EXPECT_EQ(parent < 0, tree.rows_below(f).empty());
            if (parent < 0) continue;
            EXPECT_GT(parent, f);
            size[std::size_t(parent)] += size[std::size_t(f)];
        }
        for (int f = 0; f < tree.fronts(); ++f) {   // in one piece: what lies within f's subtree has its parent there
            for (int g = f - size[std::size_t(f)] + 1; g < f; ++g) EXPECT_LE(tree.parent[std::size_t(g)], f);
        }
        for (std::size_t i = 0; i < tree.order.size(); ++i) EXPECT_EQ(tree.place[std::size_t(tree.order[i])], int(i));
    }
}

TEST(FrontTree, HoldsEveryEntryOfTheFactorAndFewMore) {
    for (const SparseMatrix& A : matrices_of_trees()) {
        const FrontTree tree = front_tree(A, some_order(A.rows()));
        const EliminationTree columns = elimination_tree(A, tree.order);
        for (int f = 0; f < tree.fronts(); ++f) {
            const auto below = tree.rows_below(f);
            EXPECT_TRUE(std::is_sorted(below.begin(), below.end()));
            const int end = tree.first[std::size_t(f) + 1];
            for (int j = tree.first[std::size_t(f)]; j < end; ++j) {
                EXPECT_LE(columns.count[std::size_t(j)], end - 1 - j + int(below.size()));
                for (SparseMatrix::InnerIterator entry(A, tree.order[std::size_t(j)]); entry; ++entry) {
                    const int row = tree.place[std::size_t(entry.index())];
                    EXPECT_TRUE(row < end || std::binary_search(below.begin(), below.end(), row));
                }
            }
            if (tree.parent[std::size_t(f)] < 0) continue;
            const auto parent = std::size_t(tree.parent[std::size_t(f)]);   // it takes all that is left
            const std::set<int> rows(tree.rows_below(int(parent)).begin(), tree.rows_below(int(parent)).end());
            EXPECT_GE(below.front(), tree.first[parent]);
            EXPECT_LT(below.front(), tree.first[parent + 1]);
            for (const int row : below) EXPECT_TRUE(row < tree.first[parent + 1] || rows.contains(row));
        }
        const long long needed = factor_operations(A, tree.order).nonzeros;
        EXPECT_EQ(needed, factor_operations(A, some_order(A.rows())).nonzeros) << "a postorder changes no entry";
        EXPECT_GE(tree.entries(), needed);
        EXPECT_LE(tree.entries(), 2 * needed);
    }
}
