/// @file
/// Two meshes in coordinates of about 1, to be held against one another. Private to the layer.
#pragma once

#include <algorithm>

#include "geometry/operators/triangle_shape.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

/// Both centred on the first and scaled by one power of two, so that no square overflows and far-away meshes lose nothing.
struct UnitPair {
    double scale;   // [1/length]
    TriangleMesh a, b;

    UnitPair(const TriangleMesh& p, const TriangleMesh& q) : scale(std::min(unit_scale(p), unit_scale(q))) {
        const Eigen::RowVector3d centre = bounding_box(p).centre();
        a = moved_to(p, scale * (p.X.rowwise() - centre));
        b = moved_to(q, scale * (q.X.rowwise() - centre));
    }
};

}   // namespace meshfolio
