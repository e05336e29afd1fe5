/// @file
/// The tufted cover (Sharp & Crane 2020, "A Laplacian for Nonmanifold Triangle Meshes"): every triangle twice, front and back, glued
/// around each edge so that a closed manifold comes about whatever the mesh is. Its intrinsic Delaunay triangulation
/// has no negative cotangent weight, on boundaries and non-manifold edges neither.
#pragma once

#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/operators/intrinsic_delaunay.h"

namespace meshfolio {

/// Adds to all lengths the smallest ε ≥ 0 that makes every triangle satisfy its triangle inequality with `relative` mean edge lengths
/// to spare (intrinsic mollification); 0 when all do.
/// @return ε [length]
double mollify(CornerValues& lengths, double relative);

/// 2m triangles: front t and back m + t of each. Around an edge, each triangle is glued to the next by angle on the side where they face
/// each other; a boundary edge glues front to back. Triangles at the same angle follow one another in their order.
IntrinsicTriangles two_sided_cover(const TriangleMesh& mesh);

struct TuftedCover {
    IntrinsicDelaunay delaunay;
    double added_length = 0;   // ε of the mollification [length]
};
TuftedCover tufted_cover(const TriangleMesh& mesh, double mollification = 1e-6);

/// C and M of the cover, halved, on the vertices of the mesh. Symmetric, and all weights ≥ 0 up to rounding
/// (−5e-16 of the largest was met), for any mesh whatsoever.
LaplaceBeltrami tufted_laplacian(const TriangleMesh& mesh, AreaForm area = AreaForm::barycentric);

}   // namespace meshfolio
