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

CurvaturePair cylinder_curvature(double r) { return {1 / (2 * r), 0}; }

CurvaturePair catenoid_curvature(double c, const Vector3& p) {
    const double cosh = std::cosh(p.z() / c);
    return {0, -1 / (c * c * cosh * cosh * cosh * cosh)};
}

Vector3 catenoid_normal(double c, const Vector3& p) {
    // Gradient of √(x² + y²) − c cosh(z/c).
    const Vector3 outward = Vector3(p.x(), p.y(), 0).normalized();
    return (outward - std::sinh(p.z() / c) * Vector3::UnitZ()).normalized();
}

Vector3 Saddle::normal_at(const Vector3& p) const { return Vector3(-a * p.x(), b * p.y(), 1).normalized(); }

CurvaturePair Saddle::curvature_at(const Vector3& p) const {
    const double fx2 = a * a * p.x() * p.x(), fy2 = b * b * p.y() * p.y(), W2 = 1 + fx2 + fy2;
    return {-((1 + fy2) * a - (1 + fx2) * b) / (2 * W2 * std::sqrt(W2)), -a * b / (W2 * W2)};
}

TriangleMesh parameter_mesh(int nx, int ny, bool periodic, const std::function<Vector3(double s, double t)>& at) {
    const int squares = periodic ? nx : nx - 1;
    TriangleMesh mesh;
    mesh.X.resize(Eigen::Index{nx} * ny, 3);
    mesh.F.resize(Eigen::Index{2} * squares * (ny - 1), 3);
    const auto index = [&](int i, int j) { return j * nx + i % nx; };
    int t = 0;
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            mesh.X.row(index(i, j)) = at(double(i) / squares, double(j) / (ny - 1)).transpose();
            if (i == squares || j + 1 == ny) continue;
            mesh.F.middleRows<2>(t) << index(i, j), index(i + 1, j), index(i + 1, j + 1),   //
                index(i, j), index(i + 1, j + 1), index(i, j + 1);
            t += 2;
        }
    }
    return mesh;
}

}   // namespace meshfolio
