/// @file
/// Better triangles over the same vertices.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Returns the triangles, m × 3, after flips that make the mesh Delaunay: edges with opposite angles of more than π in sum are flipped
/// until none is left or `passes` are done. An edge stays if the surface bends by more than 60° there, before or after the flip, or if the
/// other diagonal is an edge already. The order is that of the triangles, and only clear cases are flipped, so that rounding decides
/// nothing.
/// @throws MeshError if an edge has more than two triangles
Faces delaunay_flipped(const TriangleMesh& mesh, int passes = 10);

/// Returns, for each vertex, the step from it to the area-weighted mean of the centroids of its triangles, n × 3; zero at boundary and
/// unreferenced vertices. [length]
Positions steps_to_ring_centroids(const TriangleMesh& mesh);

}   // namespace meshfolio
