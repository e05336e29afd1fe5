/// @file
/// The triangles around each triangle: what a filter of face normals averages over.
#pragma once

#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct FaceRings {
    Incidence by_vertex;   // row t: triangles that share a vertex with t, itself among them, ascending
    Incidence by_edge;     // row t: triangles that share an edge with t, ascending; not itself
};
FaceRings face_rings(const TriangleMesh& mesh);

/// m × 3 centroids. [length]
Positions face_centroids(const TriangleMesh& mesh);

}   // namespace meshfolio
