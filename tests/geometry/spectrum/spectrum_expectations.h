/// @file
/// What every spectrum must be, for the tests of its solvers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio::testing {

inline void expect_eigenpairs(const LaplaceBeltrami& laplacian, const Spectrum& s, double residual_limit, const std::string& what) {
    double worst = 0;
    for (Eigen::Index j = 0; j < s.eigenvalues.size(); ++j) {
        const Vector Mphi = laplacian.M.cwiseProduct(s.eigenvectors.col(j));
        const double residual = (laplacian.C * s.eigenvectors.col(j) + s.eigenvalues[j] * Mphi).norm();
        const double constant = s.eigenvectors.col(j).cwiseAbs().maxCoeff();   // 1/√area of the component of a zero mode
        const double relative = residual / (s.eigenvalues[j] > 0 ? s.eigenvalues[j] * Mphi.norm() : constant);
        EXPECT_NEAR(relative, s.residuals[j], 1e-11) << what << ", pair " << j;
        worst = std::max(worst, relative);
    }
    EXPECT_LT(worst, residual_limit) << what;
    EXPECT_LT(orthonormality_error(s, laplacian.M), 1e-11) << what;
    EXPECT_TRUE(std::is_sorted(s.eigenvalues.begin(), s.eigenvalues.end())) << what;
    EXPECT_EQ(s.inertia_count, s.found_below) << what;
    EXPECT_GE(s.inertia_count, s.eigenvalues.size()) << what;
}

}   // namespace meshfolio::testing
