/// @file
/// Small patches of a mesh. Private to the layer.
#pragma once

#include <algorithm>
#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// Adds the neighbours of all `points` to them; the result ascends and names each vertex once.
inline void add_next_ring(const Incidence& ring, std::vector<int>& points) {
    const std::vector<int> inside = points;
    for (const int p : inside) points.insert(points.end(), ring.begin(p), ring.end(p));
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

/// Sets `points` to the vertex v, its neighbours and theirs, ascending.
inline void collect_two_rings(const Incidence& ring, int v, std::vector<int>& points) {
    points.assign(1, v);
    for (int rings = 0; rings < 2; ++rings) add_next_ring(ring, points);
}

}   // namespace meshfolio
