/// @file
/// Triangles that formulas stumble over.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// |u × v| over the squared longest edge, at or below which a triangle has no area: rounding of its corners makes up what is left. Such a
/// triangle bounds no surface. It gives neither stiffness nor mass to any operator.
inline constexpr double no_area = 1e-12;

/// Needle: smallest angle below 1°. Zero area: as `no_area` says.
enum class TriangleKind { sound, needle, zero_area };

TriangleKind kind_of(const TriangleMesh& mesh, int t);

}   // namespace meshfolio
