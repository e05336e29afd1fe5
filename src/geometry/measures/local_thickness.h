/// @file
/// How thick a closed shape is at a vertex.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Diameter of the largest ball that touches the surface at the vertex p from inside and has no vertex of another side in it:
/// min |q − p|²/(n_p · (p − q)) over the vertices q behind p whose normal is turned from n_p by more than 60°, so that the roughness around
/// p does not count. On a limb, to its rounded tip, it is the diameter of the limb. NaN where there is no such q (a flat open sheet).
/// [length] Compares each vertex with all. Beyond `most_pairs` comparisons only evenly spaced vertices are measured, and others are NaN.
Vector local_thickness(const TriangleMesh& mesh, double most_pairs = 1e8);

}   // namespace meshfolio
