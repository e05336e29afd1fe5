/// @file
/// Triangle meshes of implicit surfaces f = 0.
#pragma once

#include "mesh/triangle_measures.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// A function that is negative inside and positive outside, of slope about 1 near the surface. [length]
using ImplicitFunction = double (*)(const Vector3&);

/// Returns the point near p with f about 0, after `steps` Newton steps along the gradient, which comes from central differences.
Vector3 projected(ImplicitFunction f, Vector3 p, int steps = 1);

/// Returns a surface net of f = 0 (Gibson 1998): one vertex in each cell of a grid of cubes that the surface cuts, and two triangles across
/// each grid edge that it cuts. Closed if the surface lies within the box; manifold if no cell holds two sheets.
TriangleMesh surface_net(ImplicitFunction f, const Box& box, double cell);

/// Returns the mesh after `rounds` rounds, each of two passes of Delaunay flips, a step of each vertex to its ring centroid, and projection
/// back to f = 0. Boundary vertices are only projected.
TriangleMesh relaxed_on(ImplicitFunction f, TriangleMesh mesh, int rounds);

}   // namespace meshfolio
