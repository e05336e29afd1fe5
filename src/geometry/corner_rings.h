/// @file
/// Goes through the vertices of a mesh with the corners around each. What is measured at a corner is measured where it is needed, in all
/// three times a triangle: that takes less time than to keep the numbers of a large mesh and to fetch them again.
#pragma once

#include "geometry/corner_batch.h"
#include "mesh/mesh_topology.h"
#include "mesh/parallel.h"

namespace meshfolio {

/// The corners at vertex v: `size` of a batch from `first` on, in the order of their triangles.
struct Ring {
    const CornerBatch& batch;
    int vertex, first, size;

    double sum(const CornerBatch::Numbers& quantity) const {
        double sum = 0;
        for (const double *x = quantity.data() + first, *const end = x + size; x != end; ++x) sum += *x;
        return sum;
    }
    Vector3 sum(const CornerBatch::Points& quantity) const { return {sum(quantity.x), sum(quantity.y), sum(quantity.z)}; }
};

/// Reads the corners at vertices from `begin` on into a batch: some hundred of them, but those of one vertex at least.
/// @param triangles  those around each vertex; where one stands there twice, its corners at the vertex come one after the other
/// @return  the vertex after them
int read_corners(const TriangleMesh& mesh, const Incidence& triangles, int begin, int end, CornerBatch& batch);

/// On all processors: measure(batch) for all corners, then visitor(ring) for all vertices, in any order; `make_visitor` makes one for each
/// block of vertices.
template <class Measure, class MakeVisitor>
void visit_rings(const TriangleMesh& mesh, const Incidence& triangles, Measure measure, MakeVisitor make_visitor) {
    for_blocks(mesh.vertex_count(), [&](int, int begin, int end) {
        CornerBatch batch;
        auto visit = make_visitor();
        for (int v = begin; v < end;) {
            const int first = triangles.start[static_cast<std::size_t>(v)];
            const int last = read_corners(mesh, triangles, v, end, batch);
            measure(batch);
            for (; v < last; ++v) visit(Ring{batch, v, triangles.start[static_cast<std::size_t>(v)] - first, triangles.size(v)});
        }
    });
}

}   // namespace meshfolio
