/// @file
/// Scales connected components back to the volume (Desbrun et al. 1999) or area (Kazhdan, Solomon & Ben-Chen 2012) that a flow took.
#pragma once

#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct ComponentSizes {
    Vector area;          // c [length²]
    Vector volume;        // c, signed; NaN for a component that encloses none (mesh/orientation.h) [length³]
    Positions centroid;   // c × 3, of the surface [length]
};
/// Components as `topology` counts them: triangles joined by shared vertices.
ComponentSizes component_sizes(const TriangleMesh& mesh, const MeshTopology& topology);

/// Signed volume of each component on these positions, measured from a corner of its own; it means something where it encloses one.
/// [length³]
Vector component_volumes(const Faces& F, const Positions& X, const MeshTopology& topology);

/// Of each vertex, as `topology` numbers components; −1 where it has no triangle.
std::vector<int> component_of_vertices(const MeshTopology& topology);

/// Whether each component encloses a volume that differs from 0.
bool has_volume_to_keep(const TriangleMesh& mesh, const MeshTopology& topology);

/// Each component scaled about its centroid, and then moved, so that it has the volume and the centroid of `wanted`. Components without a
/// volume, or of a volume of the other sign, stay.
Positions with_volumes(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted);
/// The same for the area; components without any stay.
Positions with_areas(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted);

}   // namespace meshfolio
