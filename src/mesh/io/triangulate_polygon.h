/// @file
/// Triangles of polygons, for the readers.
#pragma once

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Largest number of corners of a polygon. Ear clipping is quadratic in the worst case and takes seconds then.
inline constexpr int max_polygon_corners = 32768;

struct PolygonTriangles {
    Faces triangles;      // (n − 2 − spikes) × 3 indices into the corners, turning as the polygon does
    bool simple = true;   // false: the polygon crosses itself (some triangles overlap) or has no area
    int spikes = 0;       // corners left out because the polygon goes out to them and back on the same line
};

/// Triangulates a polygon given by its corner positions in order: by the fan around its first corner if that is right (always if convex),
/// else by ear clipping in the plane of the Newell normal. The triangles depend neither on the place nor on the size of the polygon.
/// @throws MeshError with fewer than 3 corners or more than max_polygon_corners
PolygonTriangles triangulated_polygon(const Positions& corners);

}   // namespace meshfolio
