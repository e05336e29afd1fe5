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

/// Returns the squared distance from p to the triangle, degenerate or not, or any value ≥ `known_bound` if it is not below. [length²]
double squared_distance_to_triangle(const Vector3& p, const Vector3& x0, const Vector3& x1, const Vector3& x2,
                                    double known_bound = std::numeric_limits<double>::infinity());

/// A search tree over the triangles of a mesh.
class ClosestPoint {
public:
    /// Builds the tree. @throws MeshError if there is no triangle
    explicit ClosestPoint(TriangleMesh mesh);

    /// Returns min(squared distance from p to the surface, `known_bound`). If the result is at most `enough`, the search may stop with any
    /// value ≤ `enough` that is not below the true one. [length²]
    double squared_distance(const Vector3& p, double known_bound = std::numeric_limits<double>::infinity(), double enough = 0) const {
        return nearest(p, known_bound, enough).squared_distance;
    }
    /// The result of a search. A search that opens `most` boxes without an end gives the least distance found and a lower bound: if a point
    /// is equally far from all triangles, no tree can exclude any of them.
    struct Nearest {
        double squared_distance;   // [length²]
        int triangle;              // of mesh(); −1: none below `known_bound`
        double squared_low;        // a lower bound, less than squared_distance only if the search was cut off [length²]
        std::int64_t opened;       // boxes opened
    };
    /// Finds the triangle nearest to p among the triangles at a squared distance below `known_bound`. May stop at a squared distance ≤
    /// `enough` [length²], and stops after opening `most` boxes.
    Nearest nearest(const Vector3& p, double known_bound = std::numeric_limits<double>::infinity(), double enough = 0,
                    std::int64_t most = std::numeric_limits<std::int64_t>::max()) const;

    /// Returns the distance from p to triangle t of mesh(). [length]
    double distance_to(int t, const Vector3& p) const { return std::sqrt(to_triangle(p, t, std::numeric_limits<double>::infinity())); }

    /// Returns the mesh with its triangles in the order of the tree, equal ones once.
    const TriangleMesh& mesh() const { return mesh_; }

private:
    struct TreeBox {
        Vector3 low, high;
        double squared_distance(const Vector3& p) const { return (p - p.cwiseMax(low).cwiseMin(high)).squaredNorm(); }
        void include(const Vector3& other_low, const Vector3& other_high) {
            low = low.cwiseMin(other_low);
            high = high.cwiseMax(other_high);
        }
    };
    double to_triangle(const Vector3& p, int t, double known_bound) const;

    TriangleMesh mesh_;                          // its triangles along Morton's curve
    std::vector<std::vector<TreeBox>> levels_;   // of boxes: around successive triangles, then around successive boxes of the level before
};

/// Two meshes in coordinates of about 1, for comparison: both centred on the first and scaled by one power of two, so that no square
/// overflows and far-away meshes lose nothing.
struct UnitPair {
    double scale;   // [1/length]
    TriangleMesh a, b;

    UnitPair(const TriangleMesh& p, const TriangleMesh& q) : scale(std::min(unit_scale(p), unit_scale(q))) {
        const Eigen::RowVector3d centre = bounding_box(p).centre();
        a = moved_to(p, scale * (p.X.rowwise() - centre));
        b = moved_to(q, scale * (q.X.rowwise() - centre));
    }

    /// Returns a bound of the rounding of a distance: 2⁻⁴² of the largest coordinate, even for triangles a thousand times as long as wide.
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
