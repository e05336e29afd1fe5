/// @file
/// The shapes behind the named samples; `subdivide` as in Sample::make. Coordinates are not yet rounded.
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

/// Hermite's cubic from 0 at t = 0 to 1 at t = 1, level at both.
inline double smooth_step(double t) { return t * t * (3 - 2 * t); }

/// Every triangle into four, `times` over; afterwards each vertex is moved by `onto_surface`.
TriangleMesh subdivided_onto(TriangleMesh mesh, int times, const std::function<Vector3(const Vector3&)>& onto_surface);

}   // namespace meshfolio
