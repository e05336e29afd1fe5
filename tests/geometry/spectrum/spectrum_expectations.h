/// @file
/// Conditions on every spectrum, and ways to compute one, for the tests of its solvers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/linear/special_values.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/spectrum_certificate.h"

namespace meshfolio::testing {

inline const SpectrumOptions by_lanczos{.dense_below = 0};
inline const SpectrumOptions by_dense{.dense_below = 100'000};

/// Eigenvalues of the five-point stencil on an n × n torus of unit squares: 4 sin²(πp/n) + 4 sin²(πq/n), ascending.
inline Vector five_point_spectrum(int n) {
    Vector mu(n * n);
    for (int p = 0; p < n; ++p) {
        for (int q = 0; q < n; ++q) mu[p + n * q] = 4 * std::pow(std::sin(pi * p / n), 2) + 4 * std::pow(std::sin(pi * q / n), 2);
    }
    std::sort(mu.begin(), mu.end());
    return mu;
}

/// Compares the spectrum with a count of inertia just below its last cluster.
inline Proof counted_below_last(const LaplaceBeltrami& laplacian, const Spectrum& s) {
    const double last = s.eigenvalues.tail(1)[0];
    return last > 0 ? agreement(eigenvalues_below(laplacian, (1 - 1e-4) * last), s.eigenvalues) : Proof::undecided;
}

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
    EXPECT_NE(counted_below_last(laplacian, s), Proof::refuted) << what;
}

}   // namespace meshfolio::testing
