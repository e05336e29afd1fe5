/// @file
/// Surfaces with curvatures in closed form. H > 0 where the surface bends away from its normal, which points outwards, away from the axis,
/// or up. Each point p must lie on the surface.
#pragma once

#include <functional>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct CurvaturePair {
    double H, K;   // mean [1/length], Gaussian [1/length²]
};

/// Sphere of radius R: H = 1/R, K = 1/R².
CurvaturePair sphere_curvature(double R);
/// Torus around z: H = (R + 2r cos v)/(2r(R + r cos v)), K = cos v/(r(R + r cos v)), v the angle of p around the tube.
CurvaturePair torus_curvature(double R, double r, const Vector3& p);
/// Ellipsoid x²/a² + y²/b² + z²/c² = 1: h = (x²/a⁴ + y²/b⁴ + z²/c⁴)^−½, K = h⁴/(abc)², H = h³(a² + b² + c² − |p|²)/(2(abc)²).
CurvaturePair ellipsoid_curvature(const Vector3& half_axes, const Vector3& p);
/// Cylinder of radius r: H = 1/(2r), K = 0.
CurvaturePair cylinder_curvature(double r);
/// Catenoid x² + y² = c² cosh²(z/c): H = 0, K = −1/(c² cosh⁴(z/c)).
CurvaturePair catenoid_curvature(double c, const Vector3& p);
/// Unit normal of the catenoid, away from its axis.
Vector3 catenoid_normal(double c, const Vector3& p);

/// The graph z = ½(a x² − b y²), with a, b > 0; W² = 1 + a²x² + b²y².
struct Saddle {
    double a, b;
    double height(double x, double y) const { return 0.5 * (a * x * x - b * y * y); }
    /// Upward unit normal.
    Vector3 normal_at(const Vector3& p) const;
    /// K = −ab/W⁴, H = −[(1 + b²y²)a − (1 + a²x²)b]/(2W³).
    CurvaturePair curvature_at(const Vector3& p) const;
};

/// Returns the mesh of a surface given by parameters: nx × ny points at(s, t) over [0, 1]², s along x and t along y, row by row in x; x
/// closes where `periodic`. Each square is cut along one diagonal. `at` must keep triangles counter-clockwise seen from outside.
TriangleMesh parameter_mesh(int nx, int ny, bool periodic, const std::function<Vector3(double s, double t)>& at);

}   // namespace meshfolio
