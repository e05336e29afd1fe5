#include "geometry/measures/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

TEST(SpatialOrder, GoesThroughTheCellsOfACubeInMortonsOrder) {
    Positions corners(8, 3);
    for (int i = 0; i < 8; ++i) corners.row(7 - i) = Eigen::RowVector3d(i & 1, i >> 1 & 1, i >> 2 & 1);
    EXPECT_EQ(morton_order(corners), (std::vector<int>{7, 6, 5, 4, 3, 2, 1, 0}));
    EXPECT_EQ(morton_order(Positions::Ones(3, 3)), (std::vector<int>{0, 1, 2})) << "all in one cell";
    EXPECT_TRUE(morton_order(Positions(0, 3)).empty());
}

TEST(SpatialOrder, IsAPermutationThatShortensTheWay) {
    Positions X = irregular_sphere(5).X;
    const auto n = static_cast<int>(X.rows());
    std::vector<int> stride(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) stride[std::size_t(i)] = static_cast<int>(1009LL * i % n);
    X = Positions(X(stride, Eigen::all));
    const std::vector<int> order = morton_order(X);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], static_cast<int>(i));
    const auto way = [&](const Positions& Y) { return (Y.bottomRows(n - 1) - Y.topRows(n - 1)).rowwise().norm().sum(); };
    EXPECT_LT(way(X(order, Eigen::all)), 0.1 * way(X));
}

TEST(SpatialOrder, ReorderedIsTheSameOperator) {
    const OperatorWithMass whole = operator_with_mass(laplace_beltrami(with_unreferenced_vertex(irregular_sphere(2), {9, 9, 9})));
    std::vector<int> order(static_cast<std::size_t>(whole.size()));
    for (int i = 0; i < whole.size(); ++i) order[std::size_t(i)] = (7 * i + 3) % whole.size();
    const OperatorWithMass sorted = reordered(whole, order);
    const DenseMatrix A = whole.A, B = sorted.A;
    for (int i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(sorted.vertex[std::size_t(i)], whole.vertex[std::size_t(order[std::size_t(i)])]);
        EXPECT_EQ(sorted.M[i], whole.M[order[std::size_t(i)]]);
        for (int j = 0; j < whole.size(); ++j) EXPECT_EQ(B(i, j), A(order[std::size_t(i)], order[std::size_t(j)]));
        for (int k = sorted.A.outerIndexPtr()[i] + 1; k < sorted.A.outerIndexPtr()[i + 1]; ++k) {
            EXPECT_LT(sorted.A.innerIndexPtr()[k - 1], sorted.A.innerIndexPtr()[k]) << "columns stay sorted";
        }
    }
}
