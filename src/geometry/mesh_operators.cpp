#include "geometry/mesh_operators.h"

#include <limits>
#include <numbers>

#include "errors.h"
#include "geometry/corner_rings.h"
#include "geometry/stiffness_rows.h"
#include "geometry/triangle_shape.h"
#include "large_pages.h"

namespace meshfolio {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// n values to be written to.
Vector large_values(Eigen::Index n) {
    Vector values(n);
    prefer_large_pages(values.data(), static_cast<std::size_t>(n) * sizeof(double));
    return values;
}

/// Σ_j C_ij (x_j − x_i) = (CX)_i.
Vector3 stiffness_times_positions(const SparseMatrix& C, const Positions& X, int i) {
    Vector3 sum = Vector3::Zero();
    for (SparseMatrix::InnerIterator entry(C, i); entry; ++entry) sum += entry.value() * (X.row(entry.row()) - X.row(i)).transpose();
    return sum;
}

}   // namespace

MeshOperators mesh_operators(const TriangleMesh& mesh, const MeshTopology& topology, AreaForm area) {
    const Eigen::Index n = mesh.X.rows();
    if (static_cast<Eigen::Index>(topology.neighbours.start.size()) != n + 1)
        throw MeshError("mesh_operators: not the topology of this mesh");
    MeshOperators all{matrix_with_room_for(topology.neighbours),
                      large_values(n),
                      large_values(n),
                      large_values(n),
                      large_values(n),
                      large_values(n),
                      large_values(n)};
    const Vector& areas = area == AreaForm::barycentric ? all.barycentric : area == AreaForm::voronoi ? all.voronoi : all.mixed;
    const double scale = unit_scale(mesh, topology.vertex_faces), unit_area = 1 / (scale * scale);
    const auto measure = [&](CornerBatch& corners) {
        find_shapes(corners, scale);
        find_cotangents(corners);
        find_area_shares(corners);
        find_angles(corners);
    };
    const auto fill = [&](const Ring& ring, StiffnessRows& rows) {
        const int v = ring.vertex;
        rows.write(ring);
        all.barycentric[v] = unit_area * ring.sum(ring.batch.barycentric);
        all.voronoi[v] = unit_area * ring.sum(ring.batch.voronoi);
        all.mixed[v] = unit_area * ring.sum(ring.batch.mixed);

        const auto index = static_cast<std::size_t>(v);
        const double flat = topology.on_boundary[index] ? std::numbers::pi : 2 * std::numbers::pi;
        all.angle_deficit[v] = ring.size > 0 ? flat - ring.sum(ring.batch.angle) : 0;

        const bool interior = ring.size > 0 && !topology.on_boundary[index] && !topology.nonmanifold[index];
        const bool defined = interior && areas[v] > 0;
        const Vector3 Lx = stiffness_times_positions(all.C, mesh.X, v) / areas[v];   // −2Hn
        all.H[v] = defined ? (Lx.dot(ring.sum(ring.batch.normal)) > 0 ? -0.5 : 0.5) * Lx.norm() : undefined;
        all.K[v] = defined ? all.angle_deficit[v] / areas[v] : undefined;
    };
    visit_rings(mesh, topology.vertex_faces, measure,
                [&] { return [&fill, rows = StiffnessRows(all.C)](const Ring& ring) mutable { fill(ring, rows); }; });
    return all;
}

}   // namespace meshfolio
