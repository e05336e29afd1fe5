/// @file
/// Smaller meshes: copies with fewer vertices for nearly the same surface, and parts.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// Collapses edges, the cheapest first (Garland & Heckbert 1997), until at most `vertices` vertices are left or no collapse is allowed.
/// No collapse changes the topology or turns a triangle over: Euler number, components and boundary loops stay. Boundary vertices move
/// along the boundary; vertices at which the mesh is no manifold stay in place. Vertices that no triangle uses are left out.
/// @throws MeshError if vertices < 4, or a triangle names a vertex twice or one that does not exist
[[nodiscard]] TriangleMesh decimated(const TriangleMesh& mesh, int vertices);
/// Returns decimated(mesh, vertices) if it comes near that size. A mesh of a hundred thousand separate triangles does not.
/// @throws MeshError also if more than four times as many vertices remain
[[nodiscard]] TriangleMesh small_copy(const TriangleMesh& mesh, int vertices);

/// Returns the triangles with all corners among the `most_vertices` vertices nearest to `vertex`, counted in edges; on a tie, those that a
/// breadth-first search meets first. Returns a mesh that is no larger as a whole. Rows keep their order.
/// @throws MeshError if there is no such vertex
CompactMesh surface_patch(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int most_vertices);

}   // namespace meshfolio
