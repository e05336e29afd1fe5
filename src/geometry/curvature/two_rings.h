/// @file
/// Small patches of a mesh. Private to the layer.
#pragma once

#include <algorithm>
#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// The vertex itself, its neighbours and theirs, ascending.
inline void collect_two_rings(const Incidence& ring, int v, std::vector<int>& points) {
    points.assign(ring.begin(v), ring.end(v));
    points.push_back(v);
    for (const int* j = ring.begin(v); j != ring.end(v); ++j) points.insert(points.end(), ring.begin(*j), ring.end(*j));
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

/// And the neighbours of all of them.
inline void collect_next_ring(const Incidence& ring, std::vector<int>& points) {
    const std::vector<int> inside = points;
    for (const int p : inside) points.insert(points.end(), ring.begin(p), ring.end(p));
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

}   // namespace meshfolio
