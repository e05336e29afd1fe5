#include "geometry/spectrum/eigenvalue_enclosure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/linear/special_values.h"

using namespace meshfolio;

namespace {

/// s times the graph Laplacian of hexagons on a torus. Three neighbours each in two colours: its largest eigenvalue is 6s.
SparseMatrix hexagons(int size, double s) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < size; ++i) {
        for (int j = 0; j < size; ++j) {
            const int v = i * size + j, across = (i + j) % 2 == 0 ? 1 : size - 1;
            entries.emplace_back(v, v, 3 * s);
            for (const int w : {(i + 1) % size * size + j, (i + size - 1) % size * size + j, i * size + (j + across) % size})
                entries.emplace_back(v, w, -s);
        }
    }
    SparseMatrix S(size * size, size * size);
    S.setFromTriplets(entries.begin(), entries.end());
    return S;
}

}   // namespace

// σm is rounded before Cholesky, which can therefore succeed at a σ below μ_max: the bound of rounding must cover the difference.
TEST(EigenvalueEnclosure, ARoundedFactorProvesNoMoreThanItsRoundingLeaves) {
    constexpr double m = 1.1;
    constexpr int size = 16;
    const Vector M = Vector::Constant(size * size, m);
    int below = 0;
    for (double s = 1; s < 2; s += 0.0371) {
        const SparseMatrix S = hexagons(size, s);
        const double d = S.coeff(0, 0);   // 3s, rounded: μ_max = (d + 3s)/m
        double sigma = 2 * d / m * (1 - epsilon);
        for (int k = 0; k < 6; ++k, sigma = std::nextafter(sigma, infinity)) {
            const auto factor = factor_at(S, M, sigma);
            if (!factor) continue;
            const double product = sigma * m, excess = product - d - 2 * s - s + std::fma(sigma, m, -product);   // m(σ − μ_max), exact
            below += excess < 0 ? 1 : 0;
            EXPECT_GE(excess + m * rounding_of(*factor, M, sigma), 0) << s << " " << k;
        }
    }
    EXPECT_GT(below, 0);
}
