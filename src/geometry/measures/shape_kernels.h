/// @file
/// The inner loop of shape_distances(). Private to the layer.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Lowers nearest[v] to the squared distance of row v of X from each triangle of the clean mesh around v: squared_distance_to_triangle(),
/// to rounding. [length²]
void lower_to_shape(const TriangleMesh& clean, const Positions& X, Vector& nearest);

}   // namespace meshfolio
