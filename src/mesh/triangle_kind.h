/// @file
/// Triangles that formulas stumble over.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Needle: smallest angle below 1°. No area: the height is below the rounding of the longest edge.
enum class TriangleKind { sound, needle, zero_area };

TriangleKind kind_of(const TriangleMesh& mesh, int t);

}   // namespace meshfolio
