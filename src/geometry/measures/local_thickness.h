/// @file
/// The thickness of a closed shape at its vertices.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Returns n values, the diameter of the largest ball that touches the surface at the vertex p from inside and contains no vertex of
/// another side: min |q − p|²/(n_p · (p − q)) over the vertices q behind p with normals turned from n_p by more than 60°, so that roughness
/// around p does not count. On a limb, up to its rounded tip, it is the diameter of the limb. NaN without such a q (a flat open sheet).
/// Compares each vertex with all; beyond `most_pairs` comparisons only evenly spaced vertices, and others are NaN. [length]
Vector local_thickness(const TriangleMesh& mesh, double most_pairs = 1e8);

}   // namespace meshfolio
