/// @file
/// A triangle mesh is two matrices, and a plain value: operations return new meshes.
#pragma once

#include <Eigen/Core>

namespace meshfolio {

/// n × 3 points; each row is contiguous in memory.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// m × 3 vertex indices from 0, one triangle per row, counter-clockwise seen from outside.
using Faces = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// m × 3 values; entry (t, k) belongs to corner k of triangle t, or to the edge opposite it.
using CornerValues = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;
using Vector3 = Eigen::Vector3d;

struct TriangleMesh {
    Positions X;   // n × 3, model units
    Faces F;       // m × 3

    int vertex_count() const { return static_cast<int>(X.rows()); }
    int face_count() const { return static_cast<int>(F.rows()); }
};

/// Returns the mesh with its vertices at the positions X. @throws MeshError if X has another number of rows
[[nodiscard]] TriangleMesh moved_to(TriangleMesh mesh, Positions X);

struct CompactMesh {
    TriangleMesh mesh;
    Eigen::VectorXi original;   // row i of `mesh.X` is row original[i] of the input
};
/// Returns the mesh without the vertices that no triangle uses. Rows keep their order.
[[nodiscard]] CompactMesh without_unreferenced_vertices(const TriangleMesh& mesh);

}   // namespace meshfolio
