#include "geometry/operators/corner_rings.h"

#include <algorithm>

#include "base/at.h"

namespace meshfolio {
namespace {

constexpr int corners_at_once = 64;   // with what is computed of them they stay in the cache next to the processor

}   // namespace

int read_corners(const TriangleMesh& mesh, const Incidence& triangles, int begin, int end, CornerBatch& batch) {
    const int* const start = triangles.start.data();
    int last = begin + 1;
    while (last < end && start[last + 1] - start[begin] <= corners_at_once) ++last;
    batch.resize(start[last] - start[begin], last - begin);
    batch.first_vertex = begin;
    for (int v = begin; v <= last; ++v) batch.ring_start[at(v - begin)] = start[v] - start[begin];
    if (batch.size == 0) return last;
    // Triangles around a vertex, and their points, lie anywhere in memory: those of vertices to come are sent for in time.
    const int* const list = triangles.item.data() + start[begin];
    const int* const list_end = list + batch.size;
    const int* const later_end = std::min(list_end + corners_at_once, triangles.item.data() + triangles.item.size());
    for (const int* t = list_end; t < later_end; ++t) __builtin_prefetch(mesh.F.data() + 3 * at(*t));
    std::copy(list, list_end, batch.triangle.begin());
    int* here = batch.here.data();
    for (int v = begin; v < last; ++v) {
        for (int i = start[v]; i < start[v + 1]; ++i) *here++ = v;
    }
    std::fill_n(batch.triangle.begin() + batch.size, CornerBatch::spare, list_end[-1]);
    std::fill_n(here, CornerBatch::spare, here[-1]);
    find_sides(mesh, batch);
    for (std::size_t i = 0; i < at(batch.size); ++i) __builtin_prefetch(mesh.X.data() + 3 * at(batch.next[i]));   // nearly all are `next`
    return last;
}

}   // namespace meshfolio
