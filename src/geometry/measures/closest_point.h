/// @file
/// Distance from a point to a triangle surface: exact, by a tree of axis-aligned boxes.
#pragma once

#include <limits>
#include <vector>

#include "geometry/operators/triangle_shape.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

/// Squared distance from p to the triangle (x0, x1, x2), degenerate or not; any value ≥ `known_bound` if it is not below that. [length²]
double squared_distance_to_triangle(const Vector3& p, const Vector3& x0, const Vector3& x1, const Vector3& x2,
                                    double known_bound = std::numeric_limits<double>::infinity());

class ClosestPoint {
public:
    /// Of all triangles of `mesh`.
    /// @throws MeshError if there is no triangle
    explicit ClosestPoint(TriangleMesh mesh);

    /// min(squared distance from p to the surface, `known_bound`). As soon as the result is sure to be `enough` or less,
    /// the search may stop with any value ≤ `enough` that is not below the true one. [length²]
    double squared_distance(const Vector3& p, double known_bound = std::numeric_limits<double>::infinity(), double enough = 0) const {
        return nearest(p, known_bound, enough).squared_distance;
    }
    /// The same, and where.
    struct Nearest {
        double squared_distance;   // [length²]
        int triangle;              // of mesh(); −1: none is below `known_bound`
    };
    Nearest nearest(const Vector3& p, double known_bound = std::numeric_limits<double>::infinity(), double enough = 0) const;

    /// The mesh, its triangles in an order of their own.
    const TriangleMesh& mesh() const { return mesh_; }

private:
    struct Box {
        Vector3 low, high;
        double squared_distance(const Vector3& p) const;
        void include(const Vector3& other_low, const Vector3& other_high);
    };
    double to_triangle(const Vector3& p, int t, double known_bound) const;

    TriangleMesh mesh_;                      // its triangles along Morton's curve
    std::vector<std::vector<Box>> levels_;   // around so many triangles that follow each other, around so many of these boxes, … around all
};

/// Two meshes in coordinates of about 1, to be compared: both centred on the first and scaled by one power of two, so that no square
/// overflows and far-away meshes lose nothing.
struct UnitPair {
    double scale;   // [1/length]
    TriangleMesh a, b;

    UnitPair(const TriangleMesh& p, const TriangleMesh& q) : scale(std::min(unit_scale(p), unit_scale(q))) {
        const Eigen::RowVector3d centre = bounding_box(p).centre();
        a = moved_to(p, scale * (p.X.rowwise() - centre));
        b = moved_to(q, scale * (q.X.rowwise() - centre));
    }
};

}   // namespace meshfolio
