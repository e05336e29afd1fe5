/// @file
/// Checks of what the intrinsic functions are given: faces, a vertex count, and one number a corner.
#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// @throws MeshError naming `function` if `values` has not one row a face, or a face names a vertex outside [0, vertex_count)
void require_corner_values(const std::string& function, const Faces& F, int vertex_count, const CornerValues& values);

/// @throws MeshError naming `function` if a length is negative or not finite
void require_lengths(const std::string& function, const CornerValues& lengths);

}   // namespace meshfolio
