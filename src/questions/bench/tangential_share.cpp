#include "questions/bench/tangential_share.h"

#include <algorithm>

#include "geometry/linear/special_values.h"
#include "geometry/operators/uniform_laplacian.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

/// ‖Δx‖ below this part of the ring's edges is rounding.
constexpr double no_drift = 1e-9;

}   // namespace

Vector tangential_shares(const TriangleMesh& mesh, const MeshTopology& topology) {
    TriangleMesh centred = mesh;
    centred.X.rowwise() -= bounding_box(mesh).centre().transpose();   // far-away coordinates cost no digits
    const Positions drift = uniform_laplacian(topology) * centred.X;
    const Vector edge = mean_squared_ring_edge(centred, topology).cwiseSqrt();
    const Positions normals = vertex_normals(centred);
    Vector shares = Vector::Constant(mesh.vertex_count(), undefined);
    for (int i = 0; i < mesh.vertex_count(); ++i) {
        const auto v = static_cast<std::size_t>(i);
        if (topology.neighbours.size(i) == 0 || topology.on_boundary[v] || topology.nonmanifold[v]) continue;
        const double length = drift.row(i).norm(), along_normal = drift.row(i).dot(normals.row(i));
        shares[i] = length > no_drift * edge[i] ? std::clamp(1 - along_normal * along_normal / (length * length), 0.0, 1.0) : 0;
    }
    return shares;
}

}   // namespace meshfolio
