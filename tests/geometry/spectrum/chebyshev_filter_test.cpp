#include "geometry/spectrum/chebyshev_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/spectral_filter.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

struct LowPassCase {
    TriangleMesh mesh;
    LaplaceBeltrami laplacian;
    Spectrum spectrum;   // of all modes
    double bound;
    explicit LowPassCase(TriangleMesh m = lopsided_ellipsoid(2))
        : mesh(std::move(m)), laplacian(laplace_beltrami(mesh)), spectrum(smallest_eigenpairs(laplacian, 100'000)) {
        const OperatorWithMass whole = operator_with_mass(laplacian);
        bound = gershgorin_bound(whole.A, whole.M);
    }
    /// Between two eigenvalues that lie apart.
    double cutoff(int k) const { return 0.5 * (spectrum.eigenvalues[k - 1] + spectrum.eigenvalues[k]); }
    Vector exact_gains(LowPass kind, double at) const {
        return spectrum.eigenvalues.unaryExpr([&](double mu) { return low_pass_response(kind, at, mu); });
    }
    double error(LowPass kind, double at, int degree) const {
        const Positions exact = filtered(spectrum, laplacian.M, mesh.X, exact_gains(kind, at), 0);
        const Positions got = filtered(chebyshev_low_pass(kind, at, bound, degree), laplacian, mesh.X);
        return std::sqrt(laplacian.M.dot((got - exact).rowwise().squaredNorm()) / laplacian.M.sum());
    }
};

}   // namespace

// The polynomial of the operator is the operator of the polynomial: Φ p(μ) ΦᵀM.
TEST(ChebyshevFilter, ProductsWithTheMatrixGiveTheResponseAtEveryEigenvalue) {
    const LowPassCase c;
    for (const LowPass kind : {LowPass::ideal, LowPass::smooth}) {
        for (const int degree : {1, 2, 3, 16, 75}) {
            const ChebyshevFilter filter = chebyshev_low_pass(kind, c.cutoff(15), c.bound, degree);
            ASSERT_EQ(filter.degree(), degree);
            const Vector gains = c.spectrum.eigenvalues.unaryExpr([&](double mu) { return response(filter, mu); });
            const Positions expected = filtered(c.spectrum, c.laplacian.M, c.mesh.X, gains, 0);
            EXPECT_LT((filtered(filter, c.laplacian, c.mesh.X) - expected).cwiseAbs().maxCoeff(), 1e-11) << "degree " << degree;
        }
    }
}

TEST(ChebyshevFilter, ErrorFallsWithTheDegree) {
    const LowPassCase c;
    const double at = c.cutoff(9);
    // The passage of the damped step is about π/degree wide, in the angle arccos t: below 80 it is wider than the pass band itself.
    double ideal = c.error(LowPass::ideal, at, 80), smooth = c.error(LowPass::smooth, at, 20);
    for (int times = 2; times <= 16; times *= 2) {
        const double next_ideal = c.error(LowPass::ideal, at, 80 * times), next_smooth = c.error(LowPass::smooth, at, 20 * times);
        EXPECT_LT(next_ideal, 0.8 * ideal) << times;
        EXPECT_TRUE(next_smooth < 0.5 * smooth || next_smooth < 1e-12) << times << ": " << next_smooth;
        ideal = next_ideal;
        smooth = next_smooth;
    }
    EXPECT_LT(smooth, 1e-12) << "a smooth response is reached to rounding";
    EXPECT_LT(c.error(LowPass::ideal, at, 10'000), 1e-3 * c.error(LowPass::ideal, at, 80)) << "a jump only between two eigenvalues";
}

TEST(ChebyshevFilter, SeveralTogetherAreThoseOneByOne) {
    const LowPassCase c;
    std::vector<ChebyshevFilter> filters;
    for (const int degree : {7, 1, 40}) filters.push_back(chebyshev_low_pass(LowPass::smooth, c.cutoff(9), c.bound, degree));
    const std::vector<Positions> together = filtered(filters, c.laplacian, c.mesh.X);
    ASSERT_EQ(together.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(together[i], filtered(filters[i], c.laplacian, c.mesh.X));
    filters.push_back(chebyshev_low_pass(LowPass::smooth, c.cutoff(9), 1.1 * c.bound, 5));
    EXPECT_THROW(filtered(filters, c.laplacian, c.mesh.X), MeshError);
}

TEST(ChebyshevFilter, ConstantsStay) {
    const LowPassCase c(with_unreferenced_vertex(irregular_sphere(2), {5, 6, 7}));
    const Positions constant = Eigen::RowVector3d(3e7, -2, 1e-3).replicate(c.mesh.vertex_count(), 1);
    for (const LowPass kind : {LowPass::ideal, LowPass::smooth}) {
        for (const int degree : {1, 7, 64}) {
            const ChebyshevFilter filter = chebyshev_low_pass(kind, c.cutoff(4), c.bound, degree);
            EXPECT_NEAR(response(filter, 0), 1, 1e-12);
            EXPECT_EQ(filtered(filter, c.laplacian, constant), constant);
            EXPECT_EQ(filtered(filter, c.laplacian, c.mesh.X).row(0), c.mesh.X.row(0)) << "no triangle uses it";
        }
    }
}

// Jackson's kernel is positive, so that the damped step stays between 0 and 1, up to the scaling that makes it 1 at 0.
TEST(ChebyshevFilter, NoOvershoot) {
    for (const int degree : {8, 40, 300}) {
        const ChebyshevFilter filter = chebyshev_low_pass(LowPass::ideal, 30, 100, degree);
        double previous = response(filter, 0);
        for (int i = 0; i <= 1000; ++i) {
            const double p = response(filter, 0.1 * i);
            EXPECT_GT(p, -1e-12);
            EXPECT_LT(p, 1.01);
            EXPECT_LT(p, previous + 2e-3) << "at " << 0.1 * i;
            previous = p;
        }
    }
}

TEST(ChebyshevFilter, TheSmoothResponseIsHalfAtTheCutoff) {
    const ChebyshevFilter filter = chebyshev_low_pass(LowPass::smooth, 7, 100, 200);
    for (int i = 0; i <= 100; ++i) EXPECT_NEAR(response(filter, i), low_pass_response(LowPass::smooth, 7, i), 1e-12);
    EXPECT_NEAR(response(filter, 7), 0.5, 1e-12);
    EXPECT_EQ(low_pass_response(LowPass::ideal, 7, 6.9), 1);
    EXPECT_EQ(low_pass_response(LowPass::ideal, 7, 7.1), 0);
}

TEST(ChebyshevFilter, UnitsAndPlaceDoNotMatter) {
    const LowPassCase c;
    const double s = 1e-9, at = c.cutoff(15);
    const Positions expected = filtered(chebyshev_low_pass(LowPass::smooth, at, c.bound, 60), c.laplacian, c.mesh.X);
    const TriangleMesh tiny = scaled(c.mesh, s);
    const Positions small =
        filtered(chebyshev_low_pass(LowPass::smooth, at / (s * s), c.bound / (s * s), 60), laplace_beltrami(tiny), tiny.X);
    EXPECT_LT((small / s - expected).cwiseAbs().maxCoeff(), 1e-11);
    const Vector3 far(1e7, -1e7, 3e6);
    const Positions there = filtered(chebyshev_low_pass(LowPass::smooth, at, c.bound, 60), c.laplacian, moved_by(c.mesh, far).X);
    EXPECT_LT(((there.rowwise() - far.transpose()) - expected).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(ChebyshevFilter, CountsItsWork) {
    const LowPassCase c;
    const auto work = [&](int degree) { return operations(chebyshev_low_pass(LowPass::ideal, 1, c.bound, degree), c.laplacian); };
    EXPECT_EQ(work(40), 2 * work(20));
    EXPECT_EQ(work(1), 3 * (2 * 7 * 162 - 2 * 12 + 6 * 162)) << "162 vertices, twelve with five neighbours, the others with six";
}

TEST(ChebyshevFilter, RefusesWhatMakesNoSense) {
    EXPECT_THROW(chebyshev_low_pass(LowPass::ideal, 1, 10, 0), MeshError);
    EXPECT_THROW(chebyshev_low_pass(LowPass::ideal, 0, 10, 5), MeshError);
    EXPECT_THROW(chebyshev_low_pass(LowPass::smooth, 1, std::nan(""), 5), MeshError);
    EXPECT_THROW(filtered(chebyshev_low_pass(LowPass::smooth, 1, 10, 5), laplace_beltrami(icosphere(1)), icosphere(2).X), MeshError);
}
