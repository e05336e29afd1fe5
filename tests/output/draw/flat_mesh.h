/// @file
/// A flat mesh and an undefined value, for tests of drawing.
#pragma once

#include <limits>

#include "mesh/samples/sample_shapes.h"

namespace meshfolio::testing_tools {

inline TriangleMesh flat_mesh(int points) { return grid_mesh(points, points, 2, 2); }

inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

}   // namespace meshfolio::testing_tools
