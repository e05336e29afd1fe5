/// @file
/// Open surfaces with closed forms to measure estimates on: cylinder, catenoid and a saddle over a square. H > 0 where the surface
/// bends away from its normal, which points away from the axis, or up.
#pragma once

#include <functional>

#include "geometry/curvature/analytic_surfaces.h"

namespace meshfolio {

/// nx × ny points over [0, 1]²: x runs around (closed where `periodic`), y along. Squares are cut along one diagonal. The image of
/// point (s, t) is given by `at`, which must keep triangles counter-clockwise seen from outside.
TriangleMesh parameter_mesh(int nx, int ny, bool periodic, const std::function<Vector3(double s, double t)>& at);

CurvaturePair cylinder_curvature(double r);
/// x² + y² = c² cosh²(z/c): H = 0, K = −1/(c² cosh⁴(z/c)).
CurvaturePair catenoid_curvature(double c, const Vector3& p);
Vector3 catenoid_normal(double c, const Vector3& p);

/// z = ½(a x² − b y²), with a, b > 0; W² = 1 + a²x² + b²y².
struct Saddle {
    double a, b;
    double height(double x, double y) const { return 0.5 * (a * x * x - b * y * y); }
    Vector3 normal_at(const Vector3& p) const;
    /// K = −ab/W⁴, H = −[(1 + b²y²)a − (1 + a²x²)b]/(2W³).
    CurvaturePair curvature_at(const Vector3& p) const;
};

}   // namespace meshfolio
