/// @file
/// Distance from a point to a triangle surface: exact, by a tree of axis-aligned boxes.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Squared distance from p to the triangle (x0, x1, x2), which may be degenerate. [length²]
double squared_distance_to_triangle(const Vector3& p, const Vector3& x0, const Vector3& x1, const Vector3& x2);

class ClosestPoint {
public:
    /// Of all triangles of `mesh`, whose positions are copied.
    /// @throws MeshError if there is no triangle
    explicit ClosestPoint(const TriangleMesh& mesh);

    /// min(squared distance from p to the surface, `known_bound`). As soon as the result is sure to be `enough` or less,
    /// the search may stop with any value ≤ `enough` that is not below the true one. [length²]
    double squared_distance(const Vector3& p, double known_bound = std::numeric_limits<double>::infinity(), double enough = 0) const;

    /// What the distance to a triangle needs of it.
    struct Triangle {
        Vector3 corner, normal;         // the normal of length 1, where it has a plane
        std::array<Vector3, 2> along;   // to the other corners
        bool is_flat = false;           // without area, but for rounding
        Triangle(const Vector3& x0, const Vector3& x1, const Vector3& x2);
        /// min(squared distance, known_bound) [length²]
        double squared_distance(const Vector3& p, double known_bound) const;
    };

private:
    using Corners = std::array<Vector3, 3>;
    struct Node {
        Vector3 low, high;   // box of its triangles
        int first, count;    // triangles of a leaf; count 0: an inner node
        int right;           // second child of an inner node, whose first follows it
        double squared_distance(const Vector3& p) const;
        void include(const Vector3& other_low, const Vector3& other_high);
    };

    struct Placed {
        Vector3 centroid;
        int triangle;
    };
    int build(std::vector<Placed>& order, const std::vector<Corners>& triangles, int first, int last);

    std::vector<Node> nodes_;
    std::vector<Triangle> triangles_;   // in the order of the leaves
};

}   // namespace meshfolio
