/// @file
/// Distance from a point to a triangle surface, by a tree of axis-aligned boxes.
#pragma once

#include <cmath>
#include <cstdint>
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
    /// The same, and where. A search that opens `most` boxes without an end returns the least distance that it has found and a lower bound:
    /// where a point is equally far from all triangles, no tree can leave any of them out.
    struct Nearest {
        double squared_distance;   // [length²]
        int triangle;              // of mesh(); −1: none is below `known_bound`
        double squared_low;        // less than squared_distance only if the search was cut off [length²]
        std::int64_t opened;       // boxes
    };
    Nearest nearest(const Vector3& p, double known_bound = std::numeric_limits<double>::infinity(), double enough = 0,
                    std::int64_t most = std::numeric_limits<std::int64_t>::max()) const;

    /// From p to one triangle of mesh(). [length]
    double distance_to(int t, const Vector3& p) const { return std::sqrt(to_triangle(p, t, std::numeric_limits<double>::infinity())); }

    /// The mesh, its triangles in an order of their own, each of several equal ones once.
    const TriangleMesh& mesh() const { return mesh_; }

private:
    struct TreeBox {
        Vector3 low, high;
        double squared_distance(const Vector3& p) const;
        void include(const Vector3& other_low, const Vector3& other_high);
    };
    double to_triangle(const Vector3& p, int t, double known_bound) const;

    TriangleMesh mesh_;   // its triangles along Morton's curve
    std::vector<std::vector<TreeBox>>
        levels_;   // around so many triangles that follow each other, around so many of these boxes, … around all
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

    /// What rounding can change a distance by: 2⁻⁴² of the largest coordinate, also where a triangle is a thousand times as long as wide.
    double rounding() const {
        double largest = 0;
        for (const TriangleMesh* mesh : {&a, &b}) {
            const Box box = bounding_box(*mesh);
            largest = std::max({largest, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
        }
        return 0x1p-42 * largest;
    }
};

}   // namespace meshfolio
