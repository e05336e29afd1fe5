/// @file
/// Corners of triangles lie anywhere in memory. Whoever goes through a large mesh sends for them in time.
#pragma once

#include <algorithm>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// To be called at triangle t: the corners of a triangle some way behind it are then at hand when it comes to that.
inline void send_for_corners(const TriangleMesh& mesh, int t) {
    constexpr int ahead = 24;
    const int later = std::min(t, mesh.face_count() - 1 - ahead) + ahead;
    for (int k = 0; k < 3 && later >= 0; ++k) __builtin_prefetch(mesh.X.data() + 3 * static_cast<std::size_t>(mesh.F(later, k)));
}

}   // namespace meshfolio
