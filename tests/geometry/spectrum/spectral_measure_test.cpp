#include "geometry/spectrum/spectral_measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/stability.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// Σ_i |⟨X, φ_i⟩_M|² f(μ_i) over all modes but the constant ones, by the modes themselves.
template <class Function> double by_modes(const LaplaceBeltrami& laplacian, const Positions& X, Function f) {
    SpectrumOptions options;
    options.dense_below = 2000;
    const Spectrum all = smallest_eigenpairs(laplacian, int(X.rows()), options);
    const Positions coefficients = all.eigenvectors.transpose() * (laplacian.M.asDiagonal() * X);
    double sum = 0;
    for (Eigen::Index i = 1; i < all.eigenvalues.size(); ++i) sum += coefficients.row(i).squaredNorm() * f(all.eigenvalues[i]);
    return sum;
}

}   // namespace

TEST(SpectralMeasure, HasTheIntegralsOfTheModes) {
    for (const TriangleMesh& mesh : {irregular_sphere(2), irregular_plane(12), cube_mesh(5)}) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        const SpectralMeasure measure = spectral_measure(laplacian, mesh.X, 40);
        const double mu = largest_eigenvalue(laplacian).value;
        const auto one = [](double) { return 1.0; };
        const auto step = [&](double m) { return std::pow(1 + 3 * m / mu, -4); };
        const auto oscillating = [&](double m) { return std::pow(1 - 1.9 * m / mu, 30); };
        EXPECT_NEAR(measure.integral(one) / by_modes(laplacian, mesh.X, one), 1, 1e-10);
        EXPECT_NEAR(measure.integral(step) / by_modes(laplacian, mesh.X, step), 1, 1e-9);
        EXPECT_NEAR(measure.integral(oscillating) / by_modes(laplacian, mesh.X, oscillating), 1, 1e-8);
    }
}

// Gauss: m nodes are exact up to degree 2m − 1, and no further unless the directions ran out.
TEST(SpectralMeasure, IsExactForPolynomialsBelowTwiceItsSteps) {
    const TriangleMesh mesh = irregular_sphere(2);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const SpectralMeasure measure = spectral_measure(laplacian, mesh.X, 4);
    EXPECT_FALSE(measure.exact);
    EXPECT_EQ(measure.nodes.size(), 12);
    const double mu = largest_eigenvalue(laplacian).value;
    for (const int degree : {0, 3, 7}) {
        const auto power = [&](double m) { return std::pow(m / mu, degree); };
        EXPECT_NEAR(measure.integral(power) / by_modes(laplacian, mesh.X, power), 1, 1e-10) << degree;
    }
    const auto beyond = [&](double m) { return std::pow(m / mu, 12); };
    EXPECT_GT(std::abs(measure.integral(beyond) / by_modes(laplacian, mesh.X, beyond) - 1), 1e-6);
}

// The change in the last steps bounds the error: small if the steps suffice, large if they do not.
TEST(SpectralMeasure, UncertaintyBoundsTheError) {
    const TriangleMesh mesh = irregular_sphere(3);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const double mu = largest_eigenvalue(laplacian).value;
    const SpectralMeasure measure = spectral_measure(laplacian, mesh.X, 20);
    int known = 0, unknown = 0;
    for (double lambda = 1 / mu; lambda < 1e6 / mu; lambda *= 10) {
        const auto energy = [&](double m) { return m / std::pow(1 + lambda * m, 2); };
        const double off = std::abs(measure.integral(energy) / by_modes(laplacian, mesh.X, energy) - 1);
        const double said = measure.uncertainty(energy);
        EXPECT_LE(off, 2 * said + 1e-12) << lambda * mu;
        (said < 1e-7 ? known : unknown) += 1;
    }
    EXPECT_GE(known, 1);
    EXPECT_GE(unknown, 1);
}

TEST(SpectralMeasure, PredictsTheEnergyAndTheMotionOfARun) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const SpectralMeasure measure = spectral_measure(laplacian, mesh.X);
    EXPECT_NEAR(measure.energy([](double) { return 1.0; }) / dirichlet_energy(laplacian.C, mesh.X), 1, 1e-12);
    EXPECT_NEAR(measure.mass / surface_area(mesh), 1, 1e-12);
    const double lambda = 5 * largest_stable_step(largest_eigenvalue(laplacian));
    const Positions X = implicit_step(laplacian, lambda, implicit_step(laplacian, lambda, mesh.X));
    const auto filter = [&](double mu) { return std::pow(1 + lambda * mu, -2); };
    EXPECT_NEAR(measure.energy(filter) / dirichlet_energy(laplacian.C, X), 1, 1e-10);
    const double moved = std::sqrt(laplacian.M.dot((X - mesh.X).rowwise().squaredNorm()) / laplacian.M.sum());
    EXPECT_NEAR(measure.rms([&](double mu) { return 1 - filter(mu); }) / moved, 1, 1e-10);
}

TEST(SpectralMeasure, IgnoresPositionAndScalesWithTheMesh) {
    const TriangleMesh mesh = irregular_plane(10);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const SpectralMeasure here = spectral_measure(laplacian, mesh.X, 20);
    const SpectralMeasure there = spectral_measure(laplacian, mesh.X.rowwise() + Eigen::RowVector3d(1e4, -2e4, 5e3), 20);
    const auto filter = [&](double mu) { return 1 / (1 + mu); };
    EXPECT_NEAR(there.integral(filter) / here.integral(filter), 1, 1e-8);
    EXPECT_NEAR(spectral_measure(laplacian, 3 * mesh.X, 20).integral(filter) / here.integral(filter), 9, 1e-9);
}

// The three coordinates of a sphere of one valence are nearly eigenfunctions; a tetrahedron's are, and one step says all.
TEST(SpectralMeasure, ARegularTetrahedronHasOneMode) {
    TriangleMesh mesh;
    mesh.X.resize(4, 3);
    mesh.X << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
    mesh.F.resize(4, 3);
    mesh.F << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const SpectralMeasure measure = spectral_measure(laplacian, mesh.X);
    EXPECT_TRUE(measure.exact);
    ASSERT_EQ(measure.nodes.size(), 3);
    for (const double node : measure.nodes) EXPECT_NEAR(node / largest_eigenvalue(laplacian).value, 1, 1e-12);
}

TEST(SpectralMeasure, RefusesSizesThatDoNotFit) {
    const TriangleMesh mesh = icosphere(1);
    EXPECT_THROW(spectral_measure(laplace_beltrami(mesh), mesh.X.topRows(3)), MeshError);
    EXPECT_THROW(spectral_measure(laplace_beltrami(mesh), mesh.X, 0), MeshError);
}
