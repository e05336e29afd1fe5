/// @file
/// Smaller meshes: copies with fewer vertices for nearly the same surface, and parts.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// Returns the mesh with edges collapsed, the cheapest first (Garland & Heckbert 1997), until at most `vertices` vertices are left or no
/// collapse is allowed.
/// No collapse changes the topology or turns a triangle over: Euler number, components and boundary loops stay. Boundary vertices move
/// along the boundary; vertices at which the mesh is no manifold stay in place. Vertices that no triangle uses are left out.
/// @throws MeshError if vertices < 4, or a triangle names a vertex twice or one that does not exist
[[nodiscard]] TriangleMesh decimated(const TriangleMesh& mesh, int vertices);
/// Returns decimated(mesh, vertices), of at most some four times as many vertices: a mesh of a hundred thousand separate triangles has no
/// smaller copy.
/// @throws MeshError as decimated(), and if more than four times as many vertices remain
[[nodiscard]] TriangleMesh small_copy(const TriangleMesh& mesh, int vertices);

/// Returns the triangles with all corners among the `most_vertices` vertices nearest to `vertex`, counted in edges; on a tie, those that a
/// breadth-first search meets first. A mesh of at most `most_vertices` is returned as a whole. Rows keep their order, and `original` maps
/// them to rows of `mesh`.
/// @throws MeshError if there is no such vertex
CompactMesh surface_patch(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int most_vertices);

}   // namespace meshfolio
