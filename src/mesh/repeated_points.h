/// @file
/// Vertices that lie exactly on others.
#pragma once

#include "mesh/mesh_topology.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// How many of the vertices in use have the coordinates of an earlier one (−0 equals 0).
/// @param vertex_faces  triangles around each vertex; a vertex without any is not in use
int count_repeated_points(const TriangleMesh& mesh, const Incidence& vertex_faces);

}   // namespace meshfolio
