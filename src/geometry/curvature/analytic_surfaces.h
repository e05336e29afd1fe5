/// @file
/// Curvatures known in closed form, at points of the surface. Outward normals, H > 0 where it is convex.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct CurvaturePair {
    double H, K;   // [1/length], [1/length²]
};

CurvaturePair sphere_curvature(double R);
/// Torus around z: H = (R + 2r cos v)/(2r(R + r cos v)), K = cos v/(r(R + r cos v)), v the angle of p around the tube.
CurvaturePair torus_curvature(double R, double r, const Vector3& p);
/// Ellipsoid x²/a² + y²/b² + z²/c² = 1: h = (x²/a⁴ + y²/b⁴ + z²/c⁴)^−½, K = h⁴/(abc)², H = h³(a² + b² + c² − |p|²)/(2(abc)²).
CurvaturePair ellipsoid_curvature(const Vector3& half_axes, const Vector3& p);

}   // namespace meshfolio
