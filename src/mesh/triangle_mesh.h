/// @file
/// A triangle mesh is two matrices, and a plain value: operations return new meshes.
#pragma once

#include <Eigen/Core>

namespace meshfolio {

/// One row a point, stored x y z x y z … so that a row is contiguous.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// One row a triangle of 0-based vertex indices, counter-clockwise seen from outside.
using Faces = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// One value a corner: entry (t, k) belongs to corner k of triangle t, or to the edge opposite it.
using CornerValues = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;
using Vector3 = Eigen::Vector3d;

struct TriangleMesh {
    Positions X;   // n × 3, model units
    Faces F;       // m × 3

    int vertex_count() const { return static_cast<int>(X.rows()); }
    int face_count() const { return static_cast<int>(F.rows()); }
};

/// The same triangles over other positions.
[[nodiscard]] TriangleMesh moved_to(TriangleMesh mesh, Positions X);

/// Without the vertices no triangle uses. Rows keep their order.
struct CompactMesh {
    TriangleMesh mesh;
    Eigen::VectorXi original;   // row i of `mesh.X` is row original[i] of the input
};
[[nodiscard]] CompactMesh without_unreferenced_vertices(const TriangleMesh& mesh);

}   // namespace meshfolio
