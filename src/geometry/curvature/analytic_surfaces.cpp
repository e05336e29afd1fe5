#include "geometry/curvature/analytic_surfaces.h"

#include <cmath>

namespace meshfolio {

CurvaturePair sphere_curvature(double R) { return {1 / R, 1 / (R * R)}; }

CurvaturePair torus_curvature(double R, double r, const Vector3& p) {
    const double from_axis = std::hypot(p.x(), p.y());
    const double cos_v = (from_axis - R) / std::hypot(from_axis - R, p.z());
    return {(R + 2 * r * cos_v) / (2 * r * (R + r * cos_v)), cos_v / (r * (R + r * cos_v))};
}

CurvaturePair ellipsoid_curvature(const Vector3& half_axes, const Vector3& p) {
    const Vector3 squares = half_axes.cwiseAbs2();
    const double h = 1 / p.cwiseQuotient(squares).norm();
    const double abc = half_axes.prod();
    return {h * h * h * (squares.sum() - p.squaredNorm()) / (2 * abc * abc), std::pow(h, 4) / (abc * abc)};
}

}   // namespace meshfolio
