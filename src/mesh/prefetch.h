/// @file
/// Prefetches the corners of triangles: they lie anywhere in memory, and a loop over a large mesh would wait for each.
#pragma once

#include <algorithm>

#include "base/at.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

inline void prefetch([[maybe_unused]] const void* address) {
#ifdef __GNUC__
    __builtin_prefetch(address);
#endif
}

/// Prefetches the corners of the triangle 24 places after t.
inline void prefetch_corners(const TriangleMesh& mesh, int t) {
    constexpr int ahead = 24;
    const int later = std::min(t, mesh.face_count() - 1 - ahead) + ahead;
    for (int k = 0; k < 3 && later >= 0; ++k) {
        const double* const corner = mesh.X.data() + 3 * at(mesh.F(later, k));
        prefetch(corner);
        prefetch(corner + 2);   // every fourth lies on two cache lines
    }
}

}   // namespace meshfolio
