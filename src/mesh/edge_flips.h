/// @file
/// Better triangles over the same vertices.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Flips edges whose opposite angles sum to more than π (Delaunay) until none is left or `passes` are done. An edge stays
/// where the surface bends there by more than 60°, before or after the flip, and where the other diagonal is an edge already.
/// Edges are visited in the order of the triangles, and only clear cases are flipped, so that rounding decides nothing.
/// @throws MeshError if an edge has more than two triangles
Faces delaunay_flipped(const TriangleMesh& mesh, int passes = 10);

/// n × 3: for each vertex the step to the area-weighted mean of the centroids around it; zero on the boundary. [length]
Positions steps_to_ring_centroids(const TriangleMesh& mesh);

}   // namespace meshfolio
