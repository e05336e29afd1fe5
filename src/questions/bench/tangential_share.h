/// @file
/// How much of the uniform Laplacian of the positions lies along the surface, where it is no curvature.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// 1 − (Δx · n)²/‖Δx‖² with the uniform Δ and the area-weighted vertex normal n: n values from 0 to 1. 0 where Δx is rounding, as on a
/// symmetric flat ring; NaN on the boundary and where the mesh is not manifold.
Vector tangential_shares(const TriangleMesh& mesh, const MeshTopology& topology);

}   // namespace meshfolio
