/// @file
/// The first and second fundamental forms of the ellipsoid
///   p(u, v) = (a cos u sin v, b sin u sin v, c cos v),  u ∈ [0, 2π), v ∈ [0, π],
/// in closed form, and curvatures from them. n = p_u × p_v/|p_u × p_v| points inwards here, so curvatures are positive.
#pragma once

#include <Eigen/Core>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Ellipsoid {
    double a = 1, b = 1, c = 1;   // half axes [length]
};

/// Returns p(u, v). [length]
Vector3 ellipsoid_point(const Ellipsoid& ellipsoid, double u, double v);

struct FundamentalForms {
    Eigen::Matrix2d I;    // (E F; F G)
    Eigen::Matrix2d II;   // (e f; f g)
    Vector3 p_u, p_v;     // tangents
    Vector3 normal;       // unit, inward
};

/// Returns both fundamental forms in closed form, with D² = b²c² sin²v cos²u + a²c² sin²v sin²u + a²b² cos²v,
/// e = abc sin²v/D, f = 0, g = abc/D.
/// @throws MeshError at the poles (sin v = 0), where p_u = 0 and I is singular; for v outside [0, π]; for half axes not > 0
FundamentalForms ellipsoid_forms(const Ellipsoid& ellipsoid, double u, double v);
/// Returns the forms by central differences of ellipsoid_point() with step h in u and v: an independent oracle. The differences are of
/// fourth order; at the default step the forms agree with the closed ones to about 1e-9 of their size.
/// @throws MeshError as ellipsoid_forms(), and unless h > 0
FundamentalForms ellipsoid_forms_by_differences(const Ellipsoid& ellipsoid, double u, double v, double h = 2e-3);

/// Returns κ_n = II(t, t)/I(t, t) in the tangent direction t = du p_u + dv p_v. [1/length]
/// @throws MeshError for the direction (0, 0)
double normal_curvature(const FundamentalForms& forms, const Eigen::Vector2d& du_dv);

struct PrincipalCurvatures {
    double minimum, maximum;                        // κ₁ ≤ κ₂ [1/length]
    Vector3 minimum_direction, maximum_direction;   // unit tangents, the largest entry positive
};
/// Returns the smallest and largest normal curvature and their directions.
PrincipalCurvatures principal_curvatures(const FundamentalForms& forms);
/// Returns H = (eG − 2fF + gE)/(2(EG − F²)). [1/length]
double mean_curvature(const FundamentalForms& forms);
/// Returns K = (eg − f²)/(EG − F²). [1/length²]
double gaussian_curvature(const FundamentalForms& forms);

/// Returns κ_n at (a, 0, 0) in the unit tangent direction at angle φ from +y: a(cos²φ/b² + sin²φ/c²) (Euler).
double tip_curvature_by_angle(const Ellipsoid& ellipsoid, double phi);
/// Returns κ_n at (a, 0, 0) in the direction (du, dv) = (cos θ, sin θ): a/(b² cos²θ + c² sin²θ); not Euler's curve.
double tip_curvature_by_parameters(const Ellipsoid& ellipsoid, double theta);

}   // namespace meshfolio
