/// @file
/// Ear clipping for the readers: like triangulate_polygon of mesh_files.h, and says whether the polygon was simple.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Largest polygon that is triangulated. Ear clipping is quadratic in the worst case; this many corners stay within seconds.
inline constexpr int max_polygon_corners = 32768;

struct PolygonTriangles {
    Faces triangles;      // (n − 2 − spikes) × 3 indices into the corners, turning as the polygon does
    bool simple = true;   // false: the polygon crosses itself (some triangles overlap) or has no area
    int spikes = 0;       // corners left out because the polygon goes out to them and back on the same line
};

/// @throws MeshError with fewer than 3 corners or more than max_polygon_corners
PolygonTriangles triangulated_polygon(const Positions& corners);

}   // namespace meshfolio
