/// @file
/// What cotangents and areas need of a triangle, from positions or from edge lengths: dot products, cross product and squared edges.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/linear/special_values.h"
#include "mesh/triangle_kind.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct TriangleShape {
    std::array<double, 3> dot;            // u · v of the two edges leaving corner k [length²]
    std::array<double, 3> squared_edge;   // |e_k|² of the edge opposite corner k [length²]
    double cross;                         // |u × v| = 2A, the same at every corner [length²]

    double longest_squared_edge() const { return std::max({squared_edge[0], squared_edge[1], squared_edge[2]}); }
    /// Without area: |u × v| is rounding.
    bool degenerate() const { return !(cross > no_area * longest_squared_edge()); }
    /// 0 of a triangle without area.
    double area() const { return degenerate() ? 0 : 0.5 * cross; }
    /// cot θ_k = (u · v)/|u × v|; 0 of a triangle without area, which has no stiffness.
    double cotangent(std::size_t k) const { return degenerate() ? 0 : dot[k] / cross; }
    /// The same where a triangle without area keeps a stiffness: |u × v| is taken as no_area times the squared longest edge then.
    double floored_cotangent(std::size_t k) const {
        const double denominator = std::max(cross, no_area * longest_squared_edge());
        return denominator > 0 ? dot[k] / denominator : 0;
    }
    /// θ_k in [0, π]. The angles of a triangle add up to π whatever its shape, or Gauss–Bonnet would not hold: they are right at both ends
    /// of a side without length, and alike where all three points are one. [rad]
    double angle(std::size_t k) const {
        if (cross > 0 || dot[k] != 0) return std::atan2(cross, dot[k]);
        return squared_edge[k] > 0 ? pi / 2 : pi / 3;
    }
};

/// The triangle of three points. |u × v| is taken between the two shorter edges, where it loses least to rounding.
inline TriangleShape triangle_shape(const Vector3& p0, const Vector3& p1, const Vector3& p2) {
    const std::array<Vector3, 3> edge{p2 - p1, p0 - p2, p1 - p0};
    TriangleShape shape;
    for (std::size_t k = 0; k < 3; ++k) {
        shape.dot[k] = -edge[(k + 1) % 3].dot(edge[(k + 2) % 3]);
        shape.squared_edge[k] = edge[k].squaredNorm();
    }
    const auto& l = shape.squared_edge;
    const std::size_t longest = l[0] >= l[1] && l[0] >= l[2] ? 0 : (l[1] >= l[2] ? 1 : 2);
    shape.cross = edge[(longest + 1) % 3].cross(edge[(longest + 2) % 3]).norm();
    return shape;
}

/// Triangle t of a mesh whose positions are multiplied by `scale`.
inline TriangleShape triangle_shape(const TriangleMesh& mesh, Eigen::Index t, double scale) {
    const auto corner = [&](int k) -> Vector3 { return scale * mesh.X.row(mesh.F(t, k)).transpose(); };
    return triangle_shape(corner(0), corner(1), corner(2));
}

/// The triangle of three edge lengths. 2A by Kahan's form of Heron's formula; 0 where the triangle inequality fails.
TriangleShape triangle_shape(double l0, double l1, double l2);

/// The power of two that brings the largest extent of the mesh into [1, 2): multiplying by it is exact, and keeps squares and
/// fourth powers of lengths within range whatever the model's unit. 1 for a mesh of one point.
double unit_scale(const TriangleMesh& mesh);

}   // namespace meshfolio
