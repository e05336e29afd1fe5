/// @file
/// Goes through the vertices of a mesh with the corners around each. What is measured at a corner is measured where it is needed, in all
/// three times a triangle: that takes less time than to keep the numbers of a large mesh and to fetch them again.
#pragma once

#include "base/parallel.h"
#include "geometry/operators/corner_batch.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

/// The corners at vertex v: `size` of a batch from `first` on, in the order of their triangles.
struct Ring {
    const CornerBatch& batch;
    int index, vertex, first, size;

    double sum(const CornerBatch::Numbers& quantity) const {
        double sum = 0;
        for (const double *x = quantity.data() + first, *const end = x + size; x != end; ++x) sum += *x;
        return sum;
    }
    Vector3 sum(const CornerBatch::Points& quantity) const { return {sum(quantity.x), sum(quantity.y), sum(quantity.z)}; }
};

/// Reads the corners at vertices from `begin` on into a batch, as far as their sides: some dozens of them, but those of one vertex at
/// least.
/// @return  the vertex after them
int read_corners(const TriangleMesh& mesh, const Incidence& triangles, int begin, int end, CornerBatch& batch);

/// On all processors: measure(batch) for all corners, then visitor(ring) for all vertices, in any order; `make_visitor` makes one for each
/// block of vertices. While one batch is computed with, the points of the next one are on their way.
/// @param triangles  those around each vertex, each with three different ones
template <class Measure, class MakeVisitor>
void visit_rings(const TriangleMesh& mesh, const Incidence& triangles, Measure measure, MakeVisitor make_visitor) {
    for_blocks(mesh.vertex_count(), [&](int, int begin, int end) {
        CornerBatch two[2];
        auto visit = make_visitor();
        int next_end = read_corners(mesh, triangles, begin, end, two[0]);
        for (int v = begin, turn = 0; v < end; turn = 1 - turn) {
            CornerBatch& batch = two[turn];
            const int last = next_end;
            if (last < end) next_end = read_corners(mesh, triangles, last, end, two[1 - turn]);
            measure(batch);
            for (int i = 0; v < last; ++i, ++v) {
                const int* const first = batch.ring_start.data() + i;
                visit(Ring{batch, i, v, first[0], first[1] - first[0]});
            }
        }
    });
}

}   // namespace meshfolio
