/// @file
/// Sizes of connected components, and scaling back to the volume (Desbrun et al. 1999) or area (Kazhdan, Solomon & Ben-Chen 2012) that a
/// flow took from them. Components are those of the topology: triangles joined by shared vertices.
#pragma once

#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct ComponentSizes {
    Vector area;          // c [length²]
    Vector volume;        // c, signed; NaN for a component that encloses none (mesh/orientation.h) [length³]
    Positions centroid;   // c × 3, of the surface [length]
};
/// Returns area, signed volume (NaN if it encloses none) and centroid of the surface of each component; (0, 0, 0) without area.
ComponentSizes component_sizes(const TriangleMesh& mesh, const MeshTopology& topology);

/// Returns the signed volume of each component for positions X, summed about a corner of its first triangle; meaningful for closed
/// components. [length³]
Vector component_volumes(const Faces& F, const Positions& X, const MeshTopology& topology);

/// Returns the component of each vertex; −1 for a vertex without triangles.
std::vector<int> component_of_vertices(const MeshTopology& topology);

/// True if there are components and each encloses a volume of more than 1e-12 of the cubed box diagonal, in magnitude.
bool has_volume_to_keep(const TriangleMesh& mesh, const MeshTopology& topology);

/// Returns positions with each component scaled about its centroid and moved, so that it has the volume in `wanted` and its centroid there.
/// Components without a volume, or with one of the other sign, stay.
Positions with_volumes(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted);
/// Returns positions with each component scaled about its centroid and moved, so that it has the area and the centroid in `wanted`;
/// components without area stay.
Positions with_areas(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted);

}   // namespace meshfolio
