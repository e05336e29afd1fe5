#include "geometry/spectrum/spectral_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/spectral_reconstruction.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

struct Filtering {
    TriangleMesh mesh = lopsided_ellipsoid(2);
    Vector M;
    Spectrum spectrum;
    explicit Filtering(int k, TriangleMesh m = lopsided_ellipsoid(2)) : mesh(std::move(m)) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        M = laplacian.M;
        spectrum = smallest_eigenpairs(laplacian, k);
    }
    int modes() const { return static_cast<int>(spectrum.eigenvalues.size()); }
    Positions at(const Vector& gains, double g) const { return filtered(spectrum, M, mesh.X, gains, g); }
    /// Some gains without pattern, that of the zero mode 1.
    Vector some_gains(std::uint64_t seed) const {
        NormalNumbers random(seed);
        Vector gains(modes());
        for (double& gain : gains) gain = 3 * random.uniform();
        gains[0] = 1;
        return gains;
    }
};

}   // namespace

TEST(SpectralFilter, AllGainsOneIsTheIdentity) {
    for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(1e7, -1e7, 3e6)}) {
        const Filtering f(30, with_unreferenced_vertex(moved_by(lopsided_ellipsoid(2), offset), {7, 8, 9}));
        EXPECT_EQ(f.at(Vector::Ones(30), 1), f.mesh.X);
        EXPECT_EQ(filter_displacement(f.spectrum, f.M, f.mesh.X, Vector::Ones(30), 1), 0);
    }
}

TEST(SpectralFilter, IdealLowPassIsTheProjection) {
    const Filtering all(100'000), some(40);
    for (const int k : {1, 5, 33, 40}) {
        const Positions expected = reconstruct(all.spectrum, all.M, all.mesh.X, k);
        EXPECT_LT(largest_difference(all.at(low_pass_gains(all.spectrum.eigenvalues, k), 0), expected), 1e-12);
        EXPECT_LT(largest_difference(some.at(low_pass_gains(some.spectrum.eigenvalues, k), 0), expected), 1e-9);
    }
}

// What the modes leave over stays: the low-pass and its complement add up to the mesh.
TEST(SpectralFilter, TheRemainderIsCarriedAlong) {
    const Filtering f(25);
    const Vector none = Vector::Zero(25), all = Vector::Ones(25);
    const Positions detail = f.at(none, 1);
    EXPECT_LT(largest_difference(detail + f.at(all, 0), f.mesh.X), 1e-13);
    EXPECT_GT(detail.norm(), 1e-3) << "25 modes are not the whole of it";
    EXPECT_LT((f.spectrum.eigenvectors.transpose() * (f.M.asDiagonal() * detail)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SpectralFilter, LinearInGainsAndInPositions) {
    Filtering f(50);
    const Vector a = f.some_gains(1), b = f.some_gains(2);
    EXPECT_LT(largest_difference(f.at(0.3 * a + 0.7 * b, 0.3 * 2 + 0.7 * 5), 0.3 * f.at(a, 2) + 0.7 * f.at(b, 5)), 1e-12);
    const Positions X = f.mesh.X, Y = X.rowwise().reverse();
    const Positions of_both = filtered(f.spectrum, f.M, Positions(2 * X - 3 * Y), a, 1);
    EXPECT_LT(largest_difference(of_both, 2 * filtered(f.spectrum, f.M, X, a, 1) - 3 * filtered(f.spectrum, f.M, Y, a, 1)), 1e-12);
}

TEST(SpectralFilter, GainsOfTwoFiltersMultiply) {
    const Filtering f(50);
    const Vector a = f.some_gains(3), b = f.some_gains(4);
    const Positions twice = filtered(f.spectrum, f.M, f.at(a, 2), b, 3);
    EXPECT_LT(largest_difference(twice, f.at(a.cwiseProduct(b), 6)), 1e-11);
}

TEST(SpectralFilter, DisplacementFromTheCoefficientsIsThatOfTheMesh) {
    for (const int k : {20, 100'000}) {
        const Filtering f(k);
        for (const double g : {0.0, 1.0, 2.5}) {
            const Vector gains = f.some_gains(5);
            const double measured = std::sqrt(f.M.dot((f.at(gains, g) - f.mesh.X).rowwise().squaredNorm()) / f.M.sum());
            EXPECT_NEAR(filter_displacement(f.spectrum, f.M, f.mesh.X, gains, g), measured, 1e-12);
        }
    }
}

TEST(SpectralFilter, BandsHaveTheirGainsAndMeetSmoothly) {
    const Equaliser equaliser{{2, 40}, {1.5, 3, 0.25}};
    EXPECT_EQ(gain_at(equaliser, 0), 1) << "zero modes only say where the mesh is";
    EXPECT_EQ(gain_at(equaliser, 0.1), 1.5);
    EXPECT_NEAR(gain_at(equaliser, 10), 3, 1e-14);
    EXPECT_NEAR(gain_at(equaliser, 1e6), 0.25, 1e-14);
    EXPECT_NEAR(gain_at(equaliser, 2), 2.25, 1e-14);
    EXPECT_NEAR(gain_at(equaliser, 40), 1.625, 1e-14);
    double previous = gain_at(equaliser, 1e-3);
    for (double mu = 1e-3; mu < 1e3; mu *= 1.01) {
        EXPECT_LT(std::abs(gain_at(equaliser, mu) - previous), 0.08);
        previous = gain_at(equaliser, mu);
    }
    const Vector flat = gains_of({{2, 40}, {1, 1, 1}}, Vector::LinSpaced(9, 0, 80));
    EXPECT_EQ(flat, Vector::Ones(9));
}

TEST(SpectralFilter, MovesWithTheMesh) {
    const Filtering f(30);
    const Vector gains = f.some_gains(6);
    const Positions expected = rotated_and_moved({f.at(gains, 1), f.mesh.F}).X;
    EXPECT_LT(largest_difference(filtered(f.spectrum, f.M, rotated_and_moved(f.mesh).X, gains, 1), expected), 1e-11);
}

TEST(SpectralFilter, RefusesWhatDoesNotFit) {
    const Filtering f(10);
    EXPECT_THROW(f.at(Vector::Ones(9), 1), MeshError);
    EXPECT_THROW(filter_displacement(f.spectrum, f.M, f.mesh.X, Vector::Ones(11), 1), MeshError);
    EXPECT_THROW(gain_at({{1, 2}, {1, 2}}, 1), MeshError);
}
