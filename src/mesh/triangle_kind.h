/// @file
/// Triangles on which formulas fail: those without area, and needles.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Largest |u × v|, relative to the squared longest edge, of a triangle without area: it is rounding of the corners. Such a triangle gives
/// neither stiffness nor mass to any operator.
inline constexpr double no_area = 1e-12;

/// Needle: smallest angle below 1°. Zero area: see `no_area`.
enum class TriangleKind { sound, needle, zero_area };

/// Returns the kind of triangle t.
TriangleKind kind_of(const TriangleMesh& mesh, int t);

}   // namespace meshfolio
