#include "geometry/uniform_laplacian.h"

#include <algorithm>

namespace meshfolio {

SparseMatrix uniform_laplacian(const MeshTopology& topology) {
    const Incidence& ring = topology.neighbours;
    const int n = static_cast<int>(ring.start.size()) - 1;
    SparseMatrix L(n, n);
    int used = 0;
    for (int i = 0; i < n; ++i) used += ring.size(i) > 0 ? 1 : 0;
    L.reserve(used + ring.start.back());
    // The pattern is symmetric, so column j has an entry 1/valence(i) for each neighbour i of j.
    for (int j = 0; j < n; ++j) {
        L.startVec(j);
        if (ring.size(j) == 0) continue;
        const int* const larger = std::lower_bound(ring.begin(j), ring.end(j), j);
        const auto append_neighbours = [&](const int* first, const int* last) {
            for (const int* i = first; i != last; ++i) L.insertBack(*i, j) = 1.0 / ring.size(*i);
        };
        append_neighbours(ring.begin(j), larger);
        L.insertBack(j, j) = -1;
        append_neighbours(larger, ring.end(j));
    }
    L.finalize();
    return L;
}

Vector mean_squared_ring_edge(const TriangleMesh& mesh, const MeshTopology& topology) {
    const Incidence& ring = topology.neighbours;
    Vector mean = Vector::Zero(mesh.X.rows());
    for (int i = 0; i < mesh.vertex_count(); ++i) {
        if (ring.size(i) == 0) continue;
        for (const int* j = ring.begin(i); j != ring.end(i); ++j) mean[i] += (mesh.X.row(*j) - mesh.X.row(i)).squaredNorm();
        mean[i] /= ring.size(i);
    }
    return mean;
}

}   // namespace meshfolio
