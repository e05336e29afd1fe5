/// @file
/// Fewer vertices for nearly the same surface: edges are collapsed where that costs least (Garland & Heckbert 1997).
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// At most `vertices` vertices; more where the edges tried in order of their cost allow no further collapse. No collapse changes the
/// topology or turns a triangle over: a closed mesh stays closed, Euler number, components and the number of boundary loops stay. Boundary
/// vertices move along the boundary; vertices where the mesh is no manifold stay where they are. Vertices that no triangle uses are left
/// out. The same mesh gives the same result.
/// @throws MeshError if vertices < 4, or a triangle names a vertex twice or one that does not exist
[[nodiscard]] TriangleMesh decimated(const TriangleMesh& mesh, int vertices);
/// Returns the same for those who cannot work on a much larger mesh, such as one of a hundred thousand separate triangles.
/// @throws MeshError also if more than four times as many vertices remain
[[nodiscard]] TriangleMesh small_copy(const TriangleMesh& mesh, int vertices);

}   // namespace meshfolio
