#include "geometry/operators/uniform_laplacian.h"

#include "base/parallel.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

SparseMatrix uniform_laplacian(const MeshTopology& topology) {
    const Incidence& ring = topology.neighbours;
    const int n = static_cast<int>(ring.start.size()) - 1;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(ring.item.size() + static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        if (ring.size(i) > 0) entries.emplace_back(i, i, -1);
        for (const int* j = ring.begin(i); j != ring.end(i); ++j) entries.emplace_back(i, *j, 1.0 / ring.size(i));
    }
    SparseMatrix L(n, n);
    L.setFromTriplets(entries.begin(), entries.end());
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
