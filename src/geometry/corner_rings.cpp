#include "geometry/corner_rings.h"

namespace meshfolio {
namespace {

constexpr int corners_at_once = 64;   // with what is computed of them they stay in the cache next to the processor

std::size_t at(int index) { return static_cast<std::size_t>(index); }
const int* corners_of(const TriangleMesh& mesh, int t) { return mesh.F.data() + 3 * at(t); }
const double* point_of(const TriangleMesh& mesh, int v) { return mesh.X.data() + 3 * at(v); }

/// Triangles around a vertex, and their points, lie anywhere in memory: those of vertices to come are sent for in time.
void send_for_triangles(const TriangleMesh& mesh, const int* list, const int* end) {
    constexpr int far = 48, near = 24;
    if (end - list <= far) return;
    __builtin_prefetch(corners_of(mesh, list[far]));
    const int* const corner = corners_of(mesh, list[near]);
    for (int k = 0; k < 3; ++k) __builtin_prefetch(point_of(mesh, corner[k]));
}

/// The corner of a triangle that lies at v; of a triangle that names a vertex twice, the first one after `last`.
int place_of(const int* corner, int v, int last) {
    const bool twice = corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
    if (!twice) return (corner[1] == v ? 1 : 0) + (corner[2] == v ? 2 : 0);
    int k = last + 1;
    while (k < 2 && corner[k] != v) ++k;
    return k;
}

void set_point(CornerBatch::Points& points, std::size_t i, const double* x) {
    points.x[i] = x[0];
    points.y[i] = x[1];
    points.z[i] = x[2];
}

}   // namespace

int read_corners(const TriangleMesh& mesh, const Incidence& triangles, int begin, int end, CornerBatch& batch) {
    const int first = triangles.start[at(begin)];
    int last = begin + 1;
    while (last < end && triangles.start[at(last + 1)] - first <= corners_at_once) ++last;
    batch.resize(triangles.start[at(last)] - first);
    const int* const end_of_list = triangles.item.data() + triangles.item.size();
    std::size_t i = 0;
    for (int v = begin; v < last; ++v) {
        int k = -1;
        for (const int* t = triangles.begin(v); t != triangles.end(v); ++t, ++i) {
            send_for_triangles(mesh, t, end_of_list);
            const int* const corner = corners_of(mesh, *t);
            k = place_of(corner, v, t != triangles.begin(v) && t[-1] == *t ? k : -1);
            constexpr int next[] = {1, 2, 0}, previous[] = {2, 0, 1};
            batch.place[i] = k;
            batch.next[i] = corner[next[k]];
            batch.previous[i] = corner[previous[k]];
            set_point(batch.at_here, i, point_of(mesh, v));
            set_point(batch.at_next, i, point_of(mesh, batch.next[i]));
            set_point(batch.at_previous, i, point_of(mesh, batch.previous[i]));
        }
    }
    return last;
}

}   // namespace meshfolio
