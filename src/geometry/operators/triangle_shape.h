/// @file
/// Dot products, cross product and squared edges of a triangle, for cotangents and areas, from positions or from edge lengths.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/linear/special_values.h"
#include "mesh/triangle_kind.h"
#include "mesh/triangle_measures.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct TriangleShape {
    std::array<double, 3> dot;            // u · v of the two edges leaving corner k [length²]
    std::array<double, 3> squared_edge;   // |e_k|² of the edge opposite corner k [length²]
    double cross;                         // |u × v| = 2A, the same at every corner [length²]

    double longest_squared_edge() const { return std::max({squared_edge[0], squared_edge[1], squared_edge[2]}); }
    /// True if the triangle has no area: |u × v| is rounding.
    bool degenerate() const { return !(cross > no_area * longest_squared_edge()); }
    /// Returns A; 0 for a triangle without area. [length²]
    double area() const { return degenerate() ? 0 : 0.5 * cross; }
    /// Returns cot θ_k = (u · v)/|u × v|; 0 for a triangle without area, which has no stiffness.
    double cotangent(std::size_t k) const { return degenerate() ? 0 : dot[k] / cross; }
    /// Returns cot θ_k with |u × v| at least no_area times the squared longest edge, so that a triangle without area has a stiffness.
    double floored_cotangent(std::size_t k) const {
        const double denominator = std::max(cross, no_area * longest_squared_edge());
        return denominator > 0 ? dot[k] / denominator : 0;
    }
    /// Returns θ_k in [0, π]. The angles sum to π for every shape, as Gauss–Bonnet needs: they are π/2 at both ends of a side without
    /// length, π/3 where all three points coincide. [rad]
    double angle(std::size_t k) const {
        if (cross > 0 || dot[k] != 0) return std::atan2(cross, dot[k]);
        return squared_edge[k] > 0 ? pi / 2 : pi / 3;
    }
};

/// Returns the shape of three points. |u × v| is taken between the two shorter edges, where it loses least to rounding.
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

/// Returns the shape of triangle t of a mesh with positions multiplied by `scale`.
inline TriangleShape triangle_shape(const TriangleMesh& mesh, Eigen::Index t, double scale) {
    const auto corner = [&](int k) -> Vector3 { return scale * mesh.X.row(mesh.F(t, k)).transpose(); };
    return triangle_shape(corner(0), corner(1), corner(2));
}

/// Returns the shape of three edge lengths. 2A by Kahan's form of Heron's formula; 0 where the triangle inequality fails.
inline TriangleShape triangle_shape(double l0, double l1, double l2) {
    TriangleShape shape;
    shape.squared_edge = {l0 * l0, l1 * l1, l2 * l2};
    for (std::size_t k = 0; k < 3; ++k)
        shape.dot[k] = 0.5 * (shape.squared_edge[(k + 1) % 3] + shape.squared_edge[(k + 2) % 3] - shape.squared_edge[k]);
    std::array<double, 3> sorted{l0, l1, l2};
    std::sort(sorted.begin(), sorted.end());
    const auto [c, b, a] = sorted;
    const double sixteen_area_squared = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    shape.cross = 0.5 * std::sqrt(std::max(0.0, sixteen_area_squared));
    return shape;
}

/// Returns the power of two that brings the largest extent of the mesh into [1, 2): multiplying by it is exact, and keeps squares and
/// fourth powers of lengths within range whatever the model's unit. 1 for a mesh of one point.
inline double unit_scale(const TriangleMesh& mesh) {
    const double extent = bounding_box(mesh).extent().maxCoeff();
    if (!(extent > 0) || !std::isfinite(extent)) return 1;
    return std::ldexp(1.0, -std::clamp(std::ilogb(extent), -1000, 1000));
}

}   // namespace meshfolio
