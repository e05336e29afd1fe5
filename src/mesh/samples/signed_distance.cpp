#include "mesh/samples/signed_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace meshfolio {

double signed_distance(const Ball& ball, const Vector3& p) { return (p - ball.centre).norm() - ball.radius; }

double signed_distance(const RoundCone& cone, const Vector3& p) {
    const Vector3 axis = cone.b - cone.a, from_a = p - cone.a;
    const double length = axis.norm();
    const double along = from_a.dot(axis) / length;
    const double across = std::sqrt(std::max(0.0, from_a.squaredNorm() - along * along));
    // The mantle leans by the angle whose sine is (r_a − r_b) / length; p is nearest to the ball whose centre lies at the
    // foot of the mantle's normal through p.
    const double sine = (cone.radius_a - cone.radius_b) / length, cosine = std::sqrt(1 - sine * sine);
    const double t = std::clamp((along - across * sine / cosine) / length, 0.0, 1.0);
    return (from_a - t * axis).norm() - (cone.radius_a + t * (cone.radius_b - cone.radius_a));
}

double signed_distance(const EllipsoidBody& body, const Vector3& p) {
    // First-order distance: g / |∇g| of g = |q| − 1, q = p scaled to the unit sphere.
    const Vector3 local = body.frame * (p - body.centre);
    const Vector3 q = local.cwiseQuotient(body.half_axes);
    const double length = q.norm();
    const double slope = q.cwiseQuotient(body.half_axes).norm();
    return slope > 0 ? length * (length - 1) / slope : -body.half_axes.minCoeff();
}

double signed_distance(const RoundBox& box, const Vector3& p) {
    const Vector3 beyond = p.cwiseAbs() - (box.half_extents.array() - box.radius).matrix();
    return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0) - box.radius;
}

double smooth_union(double a, double b, double blend) {
    const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - blend / 6 * h * h * h;
}

double smooth_difference(double a, double b, double blend) { return -smooth_union(-a, b, blend); }

Eigen::Matrix3d frame_along(const Vector3& along, const Vector3& towards) {
    Eigen::Matrix3d frame;
    const Vector3 x = along.normalized();
    const Vector3 y = (towards - towards.dot(x) * x).normalized();
    frame << x.transpose(), y.transpose(), x.cross(y).transpose();
    return frame;
}

}   // namespace meshfolio
