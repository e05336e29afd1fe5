/// @file
/// The shapes of the named samples, before their coordinates are rounded; `subdivide` as in Sample::make.
#pragma once

#include <functional>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

TriangleMesh saddle_sample(int subdivide);
TriangleMesh uneven_plane_sample(int subdivide);   // flat, about 2,000 vertices, irregular triangles; before its noise
TriangleMesh lily_sample(int subdivide);
TriangleMesh creature_sample(int subdivide);
TriangleMesh bumpy_cube_sample(int subdivide);
TriangleMesh fandisk_sample(int subdivide);

/// Returns Hermite's cubic of t in [0, 1]: from 0 to 1, level at both ends.
inline double smooth_step(double t) { return t * t * (3 - 2 * t); }

/// Returns the mesh with every triangle divided into four, `times` times, and all vertices moved by `onto_surface` after each division.
TriangleMesh subdivided_onto(TriangleMesh mesh, int times, const std::function<Vector3(const Vector3&)>& onto_surface);

}   // namespace meshfolio
