/// @file
/// Scales connected components back to the volume (Desbrun et al. 1999) or area (Kazhdan, Solomon & Ben-Chen 2012) that a flow took.
#pragma once

#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct ComponentSizes {
    Vector area;          // c [length²]
    Vector volume;        // c, signed; NaN for a component with a boundary [length³]
    Positions centroid;   // c × 3, of the surface [length]
};
/// Components as `topology` counts them: triangles joined by shared vertices.
ComponentSizes component_sizes(const TriangleMesh& mesh, const MeshTopology& topology);

/// Signed volume of each component on these positions, measured from a corner of its own; it means something where it is closed. [length³]
Vector component_volumes(const Faces& F, const Positions& X, const MeshTopology& topology);

/// Of each vertex, as `topology` numbers components; −1 where it has no triangle.
std::vector<int> component_of_vertices(const MeshTopology& topology);

/// Does each component enclose a volume, so that it can be kept?
bool encloses_volume(const TriangleMesh& mesh, const MeshTopology& topology);

/// Each component scaled about its centroid, and then moved, so that it has the volume and the centroid of `wanted`. Components without a
/// volume, or of a volume of the other sign, stay.
Positions with_volumes(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted);
/// The same for the area; components without any stay.
Positions with_areas(const TriangleMesh& mesh, const MeshTopology& topology, const ComponentSizes& wanted);

}   // namespace meshfolio
