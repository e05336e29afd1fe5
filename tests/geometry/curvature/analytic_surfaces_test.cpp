#include "geometry/curvature/analytic_surfaces.h"

#include <gtest/gtest.h>

#include "geometry/curvature/fundamental_forms.h"
#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

TEST(AnalyticSurfaces, EllipsoidOfEqualAxesIsASphere) {
    const Vector3 p = 2 * Vector3(0.3, -0.8, 0.5).normalized();
    EXPECT_NEAR(ellipsoid_curvature({2, 2, 2}, p).H, sphere_curvature(2).H, 1e-15);
    EXPECT_NEAR(ellipsoid_curvature({2, 2, 2}, p).K, sphere_curvature(2).K, 1e-15);
}

// The distance h of the tangent plane from the centre knows nothing of (u, v): an oracle for the fundamental forms.
TEST(AnalyticSurfaces, EllipsoidAgreesWithItsFundamentalForms) {
    const Ellipsoid ellipsoid{1.7, 1.1, 0.6};
    NormalNumbers random(5);
    for (int i = 0; i < 100; ++i) {
        const double u = 2 * pi * random.uniform(), v = 0.02 + (pi - 0.04) * random.uniform();
        const FundamentalForms forms = ellipsoid_forms(ellipsoid, u, v);
        const CurvaturePair oracle = ellipsoid_curvature({1.7, 1.1, 0.6}, ellipsoid_point(ellipsoid, u, v));
        EXPECT_NEAR(mean_curvature(forms) / oracle.H, 1, 1e-11);
        EXPECT_NEAR(gaussian_curvature(forms) / oracle.K, 1, 1e-11);
    }
}

TEST(AnalyticSurfaces, TorusAtItsOuterInnerAndTopCircle) {
    const double R = 2, r = 0.5;
    EXPECT_NEAR(torus_curvature(R, r, {R + r, 0, 0}).H, 0.5 * (1 / r + 1 / (R + r)), 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {R + r, 0, 0}).K, 1 / (r * (R + r)), 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {0, R - r, 0}).H, 0.5 * (1 / r - 1 / (R - r)), 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {0, R - r, 0}).K, -1 / (r * (R - r)), 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {0, -R, r}).H, 0.5 / r, 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {0, -R, r}).K, 0, 1e-15);
}

// ∫K dA = ∬ cos v du dv = 0 for the torus, by the trapezoidal rule, which is exact for it.
TEST(AnalyticSurfaces, TotalCurvatureOfTheTorusVanishes) {
    const double R = 2, r = 0.5;
    double total = 0;
    for (int i = 0; i < 16; ++i) {
        const double v = 2 * pi * i / 16;
        const double rho = R + r * std::cos(v);
        total += torus_curvature(R, r, {rho, 0, r * std::sin(v)}).K * r * rho;
    }
    EXPECT_NEAR(total, 0, 1e-14);
}

}   // namespace
}   // namespace meshfolio
