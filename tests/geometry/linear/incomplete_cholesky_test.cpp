#include "geometry/linear/incomplete_cholesky.h"
#include "geometry/smoothing/diffusion_step.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace meshfolio;

/// Without fill to leave out, the incomplete factor is the whole one.
TEST(IncompleteCholesky, IsExactForATridiagonalMatrix) {
    const int n = 50;
    SparseMatrix A(n, n);
    for (int i = 0; i < n; ++i) {
        if (i > 0) A.insert(i - 1, i) = -1 - 0.01 * i;
        A.insert(i, i) = 3 + 0.1 * i;
        if (i + 1 < n) A.insert(i + 1, i) = -1 - 0.01 * (i + 1);
    }
    A.makeCompressed();
    const IncompleteCholesky factor = incomplete_cholesky(A);
    EXPECT_EQ(factor.shift, 0);
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    const Positions B = Positions::Random(n, 3);
    FourColumns Z(n);
    solve(factor, gathered(B, all), Z);
    Positions X = B;
    scatter(Z, all, X);
    EXPECT_LT((A * X - B).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(IncompleteCholesky, RaisesTheDiagonalWhereAPivotIsLost) {
    SparseMatrix A(4, 4);   // Kershaw's matrix: positive definite, its incomplete factor is not
    const double entries[4][4] = {{3, -2, 0, 2}, {-2, 3, -2, 0}, {0, -2, 3, -2}, {2, 0, -2, 3}};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            if (entries[j][i] != 0) A.insert(j, i) = entries[j][i];
        }
    }
    A.makeCompressed();
    const IncompleteCholesky factor = incomplete_cholesky(A);
    EXPECT_GT(factor.shift, 0);
    EXPECT_GT(factor.pivots.minCoeff(), 0);
}
