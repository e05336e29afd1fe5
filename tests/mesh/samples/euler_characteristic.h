/// @file
/// The Euler characteristic by counting.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio::testing {

inline int euler_characteristic(const TriangleMesh& mesh) {
    return mesh.vertex_count() - static_cast<int>(topology_of(mesh).edges.size()) + mesh.face_count();
}

}   // namespace meshfolio::testing
