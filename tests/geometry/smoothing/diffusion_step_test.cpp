#include "geometry/smoothing/diffusion_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/solver_test_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

TEST(ExplicitDiffusion, KeepsConstantsToTheLastBitAndReportsDivergence) {
    const ExplicitDiffusion diffusion(operator_with_mass(laplace_beltrami(irregular_sphere(3))));
    const auto n = static_cast<Eigen::Index>(diffusion.vertex().size());
    Positions constant(n, 3);
    constant.rowwise() = Eigen::RowVector3d(1.0 / 3, -7, 1e5);
    EXPECT_EQ(diffusion.step(0.1, constant), constant);
    FourColumns X = gathered(constant, diffusion.vertex()), Y(n, 4);
    EXPECT_TRUE(diffusion.step(0.1, X, Y, 1e5));
    EXPECT_FALSE(diffusion.step(0.1, X, Y, 0.99e5));
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        for (int c = 0; c < 3; ++c) {
            X = gathered(constant, diffusion.vertex());
            X.row(n - 1)[c] = bad;
            EXPECT_FALSE(diffusion.step(0.1, X, Y)) << bad;
        }
    }
}
