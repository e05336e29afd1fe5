/// @file
/// Solids as signed distances (negative inside, approximate away from the surface) and their smooth unions. The only irrational operation
/// is the square root, so every machine computes the same bits.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Ball {
    Vector3 centre;
    double radius;
};

/// The convex hull of two balls.
struct RoundCone {
    Vector3 a, b;
    double radius_a, radius_b;
};

/// An ellipsoid with axes along the orthonormal rows of `frame`.
struct EllipsoidBody {
    Vector3 centre, half_axes;
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
};

/// A box centred at the origin, with edges and corners rounded by `radius`.
struct RoundBox {
    Vector3 half_extents;   // radius included
    double radius;
};

/// Returns the signed distance from p to the surface of a body.
inline double signed_distance(const Ball& ball, const Vector3& p) { return (p - ball.centre).norm() - ball.radius; }

inline double signed_distance(const RoundCone& cone, const Vector3& p) {
    const Vector3 axis = cone.b - cone.a, from_a = p - cone.a;
    const double length = axis.norm();
    const double along = from_a.dot(axis) / length;
    const double across = std::sqrt(std::max(0.0, from_a.squaredNorm() - along * along));
    // The mantle leans by the angle of sine (r_a − r_b) / length; the nearest ball is centred at the foot of the mantle's normal through p.
    const double sine = (cone.radius_a - cone.radius_b) / length, cosine = std::sqrt(1 - sine * sine);
    const double t = std::clamp((along - across * sine / cosine) / length, 0.0, 1.0);
    return (from_a - t * axis).norm() - (cone.radius_a + t * (cone.radius_b - cone.radius_a));
}

inline double signed_distance(const EllipsoidBody& body, const Vector3& p) {
    // The distance to first order: g / |∇g| with g = |q| − 1, q being p scaled to the unit sphere.
    const Vector3 local = body.frame * (p - body.centre);
    const Vector3 q = local.cwiseQuotient(body.half_axes);
    const double length = q.norm();
    const double slope = q.cwiseQuotient(body.half_axes).norm();
    return slope > 0 ? length * (length - 1) / slope : -body.half_axes.minCoeff();
}

inline double signed_distance(const RoundBox& box, const Vector3& p) {
    const Vector3 beyond = p.cwiseAbs() - (box.half_extents.array() - box.radius).matrix();
    return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0) - box.radius;
}

/// Returns min(a, b) with the crease rounded over a distance `blend`: twice differentiable, never larger than min(a, b).
inline double smooth_union(double a, double b, double blend) {
    const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - blend / 6 * h * h * h;
}

/// Returns max(a, −b) with the crease rounded: b taken out of a.
inline double smooth_difference(double a, double b, double blend) { return -smooth_union(-a, b, blend); }

/// Returns a matrix with orthonormal rows: the first along `along`, the second as near to `towards` as possible.
inline Eigen::Matrix3d frame_along(const Vector3& along, const Vector3& towards) {
    Eigen::Matrix3d frame;
    const Vector3 x = along.normalized();
    const Vector3 y = (towards - towards.dot(x) * x).normalized();
    frame << x.transpose(), y.transpose(), x.cross(y).transpose();
    return frame;
}

}   // namespace meshfolio
