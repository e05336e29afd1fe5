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
/// Measures each component.
ComponentSizes component_sizes(const TriangleMesh& mesh, const MeshTopology& topology);

/// Returns the signed volume of each component for positions X, measured from a corner of its own; meaningful for closed ones. [length³]
Vector component_volumes(const Faces& F, const Positions& X, const MeshTopology& topology);

/// Returns the component of each vertex; −1 for a vertex without triangles.
std::vector<int> component_of_vertices(const MeshTopology& topology);

/// True if every component encloses a volume other than 0.
bool has_volume_to_keep(const TriangleMesh& mesh, const MeshTopology& topology);

/// Returns positions with each component scaled about its centroid and moved, so that it has the volume and the centroid of `wanted`.
/// Components without a volume, or with one of the other sign, stay.
Positions with_volumes(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted);
/// Returns positions with each component scaled and moved to the area and the centroid of `wanted`; components without area stay.
Positions with_areas(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted);

}   // namespace meshfolio
