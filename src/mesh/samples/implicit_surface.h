/// @file
/// Triangle meshes of implicit surfaces f = 0.
#pragma once

#include "mesh/triangle_measures.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// A function that is negative inside and positive outside, of slope about 1 near the surface. [length]
using ImplicitFunction = double (*)(const Vector3&);

/// Returns the nearby point with f = 0, by Newton steps along the gradient, from central differences.
Vector3 projected(ImplicitFunction f, Vector3 p, int steps = 1);

/// Returns a surface net of f = 0 (Gibson 1998): one vertex in each cell of a grid of cubes that the surface cuts, and two triangles across
/// each grid edge that it cuts. Closed if the surface lies within the box; manifold if no cell holds two sheets.
TriangleMesh surface_net(ImplicitFunction f, const Box& box, double cell);

/// Returns the mesh after rounds of Delaunay flips, steps towards the ring centroids, and projection back to f = 0.
TriangleMesh relaxed_on(ImplicitFunction f, TriangleMesh mesh, int rounds);

}   // namespace meshfolio
