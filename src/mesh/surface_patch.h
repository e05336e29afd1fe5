/// @file
/// A piece of a mesh that is too large for what is to be tried on it.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// The triangles whose vertices are all among the `most_vertices` nearest to `vertex`, counted in edges, of those equally near the ones
/// met first; the whole mesh when it is no larger. Rows keep their order.
/// @throws MeshError if there is no such vertex
CompactMesh surface_patch(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int most_vertices);

}   // namespace meshfolio
