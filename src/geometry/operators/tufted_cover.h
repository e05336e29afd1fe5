/// @file
/// The tufted cover (Sharp & Crane 2020, "A Laplacian for Nonmanifold Triangle Meshes"): every triangle twice, front and back, glued around
/// each edge to a closed manifold, for any mesh. Its intrinsic Delaunay triangulation has no negative cotangent weight, not even on
/// boundaries and non-manifold edges.
#pragma once

#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/operators/intrinsic_delaunay.h"

namespace meshfolio {

/// Adds to all lengths the smallest ε ≥ 0 such that every triangle satisfies its triangle inequality with `relative` mean edge lengths to
/// spare (intrinsic mollification). Returns ε. [length]
double mollify(CornerValues& lengths, double relative);

/// Returns 2m glued triangles: front t and back m + t of each. Around an edge, each triangle is glued to the next by angle on the side
/// where they face each other; a boundary edge glues front to back. Triangles at the same angle follow one another in their order.
IntrinsicTriangles two_sided_cover(const TriangleMesh& mesh);

/// Returns the intrinsic Delaunay triangulation of two_sided_cover(mesh), mollified by 1e-6 mean edge lengths.
IntrinsicTriangles tufted_cover(const TriangleMesh& mesh);

/// Returns half of C and M of tufted_cover(mesh), on the vertices of the mesh. Symmetric, and all weights ≥ 0 up to rounding (−5e-16 of the
/// largest was met), for any mesh.
LaplaceBeltrami tufted_laplacian(const TriangleMesh& mesh, AreaForm area = AreaForm::barycentric);

}   // namespace meshfolio
