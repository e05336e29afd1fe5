/// @file
/// The inner loop of shape_distances(). Private to the layer.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Lowers nearest[v] to squared_distance_to_triangle(), to rounding, of row v of X and each triangle of the clean mesh around v. [length²]
void lower_to_shape(const TriangleMesh& clean, const Positions& X, Vector& nearest);

}   // namespace meshfolio
