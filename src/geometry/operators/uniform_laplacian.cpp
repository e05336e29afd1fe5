#include "geometry/operators/uniform_laplacian.h"

#include "base/parallel.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

SparseMatrix uniform_laplacian(const MeshTopology& topology) {
    const Incidence& ring = topology.neighbours;
    const int n = static_cast<int>(ring.start.size()) - 1;
    SparseMatrix L(n, n);
    int* const start = L.outerIndexPtr();
    start[0] = 0;
    for (int j = 0; j < n; ++j) start[j + 1] = start[j] + (ring.size(j) > 0 ? ring.size(j) + 1 : 0);
    L.resizeNonZeros(start[n]);
    // The pattern is symmetric, so column j has an entry 1/valence(i) for each neighbour i of j.
    for_each_index(n, [&](int j) {
        int* row = L.innerIndexPtr() + start[j];
        double* value = L.valuePtr() + start[j];
        const auto append = [&](int i, double x) {
            *row++ = i;
            *value++ = x;
        };
        const int* i = ring.begin(j);
        for (; i != ring.end(j) && *i < j; ++i) append(*i, 1.0 / ring.size(*i));
        if (ring.size(j) > 0) append(j, -1);
        for (; i != ring.end(j); ++i) append(*i, 1.0 / ring.size(*i));
    });
    return L;
}

LaplaceBeltrami uniform_operator(const MeshTopology& topology) {
    const Incidence& ring = topology.neighbours;
    Vector valence(static_cast<Eigen::Index>(ring.start.size()) - 1);
    for (int v = 0; v < valence.size(); ++v) valence[v] = ring.size(v);
    return {weighted_by_rows(uniform_laplacian(topology), valence), valence};
}

LaplaceBeltrami uniform_operator(const TriangleMesh& mesh, const MeshTopology& topology) {
    return assembled_joined(
        mesh, [&](const TriangleMesh& joined) { return uniform_operator(&joined == &mesh ? topology : topology_of(joined)); });
}

Vector mean_squared_ring_edge(const TriangleMesh& mesh, const MeshTopology& topology) {
    const Incidence& ring = topology.neighbours;
    Vector mean = Vector::Zero(mesh.X.rows());
    for_each_index(mesh.vertex_count(), [&](int i) {
        if (ring.size(i) == 0) return;
        for (const int* j = ring.begin(i); j != ring.end(i); ++j) mean[i] += (mesh.X.row(*j) - mesh.X.row(i)).squaredNorm();
        mean[i] /= ring.size(i);
    });
    return mean;
}

}   // namespace meshfolio
