/// @file
/// Triangle meshes of implicit surfaces f = 0.
#pragma once

#include "mesh/triangle_measures.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Negative inside, positive outside, slope about 1 near the surface. [length]
using ImplicitFunction = double (*)(const Vector3&);

/// The nearby point with f = 0, by Newton steps along the gradient (central differences of width `step`).
Vector3 projected(ImplicitFunction f, Vector3 p, int steps = 1);

/// Surface nets (Gibson 1998): one vertex in each cell of a grid of cubes that f = 0 cuts, quads across the cut grid edges,
/// each cut in two. Closed when the surface lies within the box; manifold when no cell holds two sheets.
TriangleMesh surface_net(ImplicitFunction f, const Box& box, double cell);

/// Rounds of: Delaunay flips, tangential steps towards the ring centroids, projection back to f = 0.
TriangleMesh relaxed_on(ImplicitFunction f, TriangleMesh mesh, int rounds);

}   // namespace meshfolio
