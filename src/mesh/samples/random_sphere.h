/// @file
/// Random points on the unit sphere and their convex hull: the least regular mesh that is still Delaunay.
#pragma once

#include <cstdint>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// The hull of the six points on the axes and `points` − 6 independent, uniformly distributed ones; 2·points − 4 triangles.
/// @throws UsageError for fewer than six points
TriangleMesh random_sphere(int points, std::uint64_t seed);

}   // namespace meshfolio
