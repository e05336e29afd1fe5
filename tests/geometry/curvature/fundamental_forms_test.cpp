#include "geometry/curvature/fundamental_forms.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <limits>

#include "base/errors.h"
#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

constexpr Ellipsoid egg{1.7, 1.1, 0.6};

/// Calls visit(u, v) at random points, at least 0.05 from the poles.
template <class Visit> void at_random_points(int count, Visit visit) {
    NormalNumbers random(2024);
    for (int i = 0; i < count; ++i) {
        const double u = 2 * pi * random.uniform();
        visit(u, 0.05 + (pi - 0.1) * random.uniform());
    }
}

TEST(FundamentalForms, AgreeWithDifferences) {
    at_random_points(200, [](double u, double v) {
        const FundamentalForms closed = ellipsoid_forms(egg, u, v), differences = ellipsoid_forms_by_differences(egg, u, v);
        EXPECT_LT((closed.I - differences.I).norm(), 1e-9);
        EXPECT_LT((closed.II - differences.II).norm(), 2e-8);
        EXPECT_LT((closed.p_u - differences.p_u).norm(), 1e-9);
        EXPECT_LT((closed.p_v - differences.p_v).norm(), 1e-9);
        EXPECT_LT((closed.normal - differences.normal).norm(), 1e-8);
    });
}

TEST(FundamentalForms, DifferencesAreOfFourthOrder) {
    const auto error = [](double h) {
        return (ellipsoid_forms(egg, 0.7, 1.1).II - ellipsoid_forms_by_differences(egg, 0.7, 1.1, h).II).norm();
    };
    EXPECT_NEAR(std::log2(error(0.08) / error(0.04)), 4, 0.1);
}

TEST(FundamentalForms, AreThoseOfTheTangentsAndTheNormalPointsInwards) {
    at_random_points(100, [](double u, double v) {
        const FundamentalForms forms = ellipsoid_forms(egg, u, v);
        EXPECT_NEAR(forms.I(0, 0), forms.p_u.squaredNorm(), 1e-14);
        EXPECT_NEAR(forms.I(0, 1), forms.p_u.dot(forms.p_v), 1e-14);
        EXPECT_NEAR(forms.I(1, 1), forms.p_v.squaredNorm(), 1e-14);
        EXPECT_LT((forms.p_u.cross(forms.p_v).normalized() - forms.normal).norm(), 1e-12);
        EXPECT_LT(forms.normal.dot(ellipsoid_point(egg, u, v)), 0);
        EXPECT_NEAR(forms.normal.norm(), 1, 1e-15);
    });
}

// K = h⁴/(abc)² with h the distance of the tangent plane from the centre.
TEST(FundamentalForms, GaussianCurvatureFromTheTangentPlane) {
    const double abc = egg.a * egg.b * egg.c;
    at_random_points(100, [&](double u, double v) {
        const FundamentalForms forms = ellipsoid_forms(egg, u, v);
        const double h = -forms.normal.dot(ellipsoid_point(egg, u, v));
        EXPECT_NEAR(gaussian_curvature(forms) / (std::pow(h, 4) / (abc * abc)), 1, 1e-11);
    });
}

TEST(FundamentalForms, SphereOfRadiusRHasOneCurvatureEverywhere) {
    at_random_points(50, [](double u, double v) {
        const FundamentalForms forms = ellipsoid_forms({2, 2, 2}, u, v);
        EXPECT_NEAR(mean_curvature(forms), 0.5, 1e-12);
        EXPECT_NEAR(gaussian_curvature(forms), 0.25, 1e-12);
        EXPECT_NEAR(normal_curvature(forms, {0.3, -0.7}), 0.5, 1e-12);
        const PrincipalCurvatures principal = principal_curvatures(forms);
        EXPECT_NEAR(principal.minimum, 0.5, 1e-12);
        EXPECT_NEAR(principal.maximum, 0.5, 1e-12);
    });
}

TEST(FundamentalForms, PrincipalCurvaturesAreTheExtremesOfNormalCurvature) {
    at_random_points(30, [](double u, double v) {
        const FundamentalForms forms = ellipsoid_forms(egg, u, v);
        const PrincipalCurvatures principal = principal_curvatures(forms);
        EXPECT_NEAR(principal.minimum + principal.maximum, 2 * mean_curvature(forms), 1e-11 * principal.maximum);
        EXPECT_NEAR(principal.minimum * principal.maximum / gaussian_curvature(forms), 1, 1e-11);
        EXPECT_NEAR(principal.minimum_direction.dot(principal.maximum_direction), 0, 1e-10);
        EXPECT_NEAR(principal.maximum_direction.norm(), 1, 1e-14);
        EXPECT_NEAR(principal.maximum_direction.dot(forms.normal), 0, 1e-11);
        for (int i = 0; i < 64; ++i) {
            const Eigen::Vector2d t(std::cos(pi * i / 64), std::sin(pi * i / 64));
            const double kappa = normal_curvature(forms, t);
            EXPECT_GT(kappa, principal.minimum * (1 - 1e-12));
            EXPECT_LT(kappa, principal.maximum * (1 + 1e-12));
            // Euler: κ₁cos² + κ₂sin² of the angle between the unit tangent and the first principal direction
            const Vector3 tangent = (t[0] * forms.p_u + t[1] * forms.p_v).normalized();
            const double cos_angle = tangent.dot(principal.minimum_direction);
            EXPECT_NEAR(kappa, principal.maximum + (principal.minimum - principal.maximum) * cos_angle * cos_angle, 1e-9 * kappa);
        }
    });
}

TEST(FundamentalForms, AtTheTipOfTheFirstAxis) {
    const FundamentalForms forms = ellipsoid_forms(egg, 0, pi / 2);
    EXPECT_LT((ellipsoid_point(egg, 0, pi / 2) - Vector3(egg.a, 0, 0)).norm(), 1e-15);
    EXPECT_LT((forms.I - Eigen::Matrix2d(Eigen::Vector2d(egg.b * egg.b, egg.c * egg.c).asDiagonal())).norm(), 1e-15);
    EXPECT_LT((forms.II - egg.a * Eigen::Matrix2d::Identity()).norm(), 1e-15);
    const PrincipalCurvatures principal = principal_curvatures(forms);
    EXPECT_NEAR(principal.minimum, egg.a / (egg.b * egg.b), 1e-14);
    EXPECT_NEAR(principal.maximum, egg.a / (egg.c * egg.c), 1e-14);
    EXPECT_LT((principal.minimum_direction - Vector3::UnitY()).norm(), 1e-14);
    EXPECT_LT((principal.maximum_direction - Vector3::UnitZ()).norm(), 1e-14);
    EXPECT_NEAR(gaussian_curvature(forms), egg.a * egg.a / std::pow(egg.b * egg.c, 2), 1e-13);
}

// "Direction" as an angle in the tangent plane and as (du, dv) = (cos θ, sin θ) are different curves, which meet on the axes.
TEST(FundamentalForms, TwoMeaningsOfDirectionAtTheTip) {
    EXPECT_NEAR(tip_curvature_by_angle(egg, pi / 4), 3.06, 5e-3);
    EXPECT_NEAR(tip_curvature_by_parameters(egg, pi / 4), 2.17, 5e-3);
    const FundamentalForms forms = ellipsoid_forms(egg, 0, pi / 2);
    for (int i = 0; i < 32; ++i) {
        const double angle = 2 * pi * i / 32, cos_angle = std::cos(angle), sin_angle = std::sin(angle);
        EXPECT_NEAR(tip_curvature_by_parameters(egg, angle), normal_curvature(forms, {cos_angle, sin_angle}), 1e-13);
        // p_u = (0, b, 0) and p_v = (0, 0, −c): the unit tangent at `angle` from +y has du = cos/b, dv = −sin/c
        EXPECT_NEAR(tip_curvature_by_angle(egg, angle), normal_curvature(forms, {cos_angle / egg.b, -sin_angle / egg.c}), 1e-13);
    }
}

TEST(FundamentalForms, ScaleWithTheEllipsoid) {
    const FundamentalForms one = ellipsoid_forms(egg, 0.4, 2), three = ellipsoid_forms({5.1, 3.3, 1.8}, 0.4, 2);
    EXPECT_LT((three.I - 9 * one.I).norm(), 1e-13);
    EXPECT_LT((three.II - 3 * one.II).norm(), 1e-13);
    EXPECT_NEAR(mean_curvature(three), mean_curvature(one) / 3, 1e-14);
}

TEST(FundamentalForms, PolesAreExplained) {
    for (const double v : {0.0, pi}) {   // (0, π) is the point that an earlier report took for (a, 0, 0)
        try {
            ellipsoid_forms(egg, 0, v);
            FAIL() << "v = " << v;
        } catch (const MeshError& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find("pole"), std::string::npos) << message;
            EXPECT_NE(message.find("u = 0, v = π/2"), std::string::npos) << message;
        }
        EXPECT_THROW(ellipsoid_forms_by_differences(egg, 0, v), MeshError);
    }
}

TEST(FundamentalForms, RefuseInvalidEllipsoidsPointsAndDirections) {
    EXPECT_THROW(ellipsoid_forms({1, 0, 1}, 0, 1), MeshError);
    EXPECT_THROW(ellipsoid_forms({1, -1, 1}, 0, 1), MeshError);
    EXPECT_THROW(ellipsoid_forms({1, 1, std::numeric_limits<double>::infinity()}, 0, 1), MeshError);
    EXPECT_THROW(ellipsoid_forms(egg, 0, -0.5), MeshError);
    EXPECT_THROW(ellipsoid_forms(egg, 0, 4), MeshError);
    EXPECT_THROW(ellipsoid_forms(egg, std::numeric_limits<double>::quiet_NaN(), 1), MeshError);
    EXPECT_THROW(ellipsoid_forms_by_differences(egg, 0, 1, 0), MeshError);
    EXPECT_THROW(normal_curvature(ellipsoid_forms(egg, 0, 1), {0, 0}), MeshError);
}

}   // namespace
}   // namespace meshfolio
