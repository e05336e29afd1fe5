/// @file
/// Solids as signed distances (negative inside, approximate away from the surface) and their smooth unions. Square roots
/// are the only irrational operation, so every machine computes the same bits.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Ball {
    Vector3 centre;
    double radius;
};

/// Convex hull of two balls.
struct RoundCone {
    Vector3 a, b;
    double radius_a, radius_b;
};

/// Axes along the orthonormal rows of `frame`.
struct EllipsoidBody {
    Vector3 centre, half_axes;
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
};

/// A box with edges and corners rounded by `radius`, centred at the origin.
struct RoundBox {
    Vector3 half_extents;   // radius included
    double radius;
};

double signed_distance(const Ball& ball, const Vector3& p);
double signed_distance(const RoundCone& cone, const Vector3& p);
double signed_distance(const EllipsoidBody& body, const Vector3& p);
double signed_distance(const RoundBox& box, const Vector3& p);

/// min(a, b) with the crease rounded over a distance `blend`: twice differentiable, never larger than min(a, b).
double smooth_union(double a, double b, double blend);
/// max(a, −b) with the crease rounded: b taken out of a.
double smooth_difference(double a, double b, double blend);

/// Orthonormal rows: the first along `along`, the second as near to `towards` as it can be.
Eigen::Matrix3d frame_along(const Vector3& along, const Vector3& towards);

}   // namespace meshfolio
