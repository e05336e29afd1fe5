#include "geometry/operators/mesh_operators.h"

#include <numbers>

#include "base/errors.h"
#include "base/large_pages.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/closed_fans.h"
#include "geometry/operators/corner_rings.h"
#include "geometry/operators/stiffness_rows.h"
#include "geometry/operators/triangle_shape.h"

namespace meshfolio {
namespace {

/// n values to be written to.
Vector large_values(Eigen::Index n) {
    Vector values(n);
    prefer_large_pages(values.data(), static_cast<std::size_t>(n) * sizeof(double));
    return values;
}

/// Σ_j C_ij (x_j − x_i) = (CX)_i.
Vector3 stiffness_times_positions(const SparseMatrix& C, const Positions& X, int i) {
    const double* const here = X.data() + 3 * static_cast<std::size_t>(i);
    double x = 0, y = 0, z = 0;
    for (int entry = C.outerIndexPtr()[i], end = C.outerIndexPtr()[i + 1]; entry < end; ++entry) {
        const double* const there = X.data() + 3 * static_cast<std::size_t>(C.innerIndexPtr()[entry]);
        const double weight = C.valuePtr()[entry];
        x += weight * (there[0] - here[0]);
        y += weight * (there[1] - here[1]);
        z += weight * (there[2] - here[2]);
    }
    return {x, y, z};
}

/// What is summed over the corners around a vertex.
struct RingSums {
    double barycentric = 0, voronoi = 0, mixed = 0, angle = 0;
    Vector3 normal = Vector3::Zero();

    explicit RingSums(const Ring& ring) {
        const CornerBatch& b = ring.batch;
        const auto first = static_cast<std::size_t>(ring.first);
        for (std::size_t i = first; i < first + static_cast<std::size_t>(ring.size); ++i) {
            barycentric += b.barycentric[i];
            voronoi += b.voronoi[i];
            mixed += b.mixed[i];
            angle += b.angle[i];
            normal += Vector3(b.normal.x[i], b.normal.y[i], b.normal.z[i]);
        }
    }
};

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
    const Vector& areas = all.areas(area);
    const double scale = unit_scale(mesh, topology.vertex_faces), unit_area = 1 / (scale * scale);
    const auto measure = [&](CornerBatch& corners) {
        find_closed_fans(corners);
        find_shapes(mesh, scale, corners);
        find_cotangents(corners);
        find_area_shares(corners);
        find_angles(corners);
    };
    const auto fill = [&](const Ring& ring, StiffnessRows& rows) {
        const int v = ring.vertex;
        rows.write(ring);
        const RingSums sums(ring);
        all.barycentric[v] = unit_area * sums.barycentric;
        all.voronoi[v] = unit_area * sums.voronoi;
        all.mixed[v] = unit_area * sums.mixed;

        const auto index = static_cast<std::size_t>(v);
        const double flat = topology.on_boundary[index] ? std::numbers::pi : 2 * std::numbers::pi;
        all.angle_deficit[v] = ring.size > 0 ? flat - sums.angle : 0;

        const bool interior = ring.size > 0 && !topology.on_boundary[index] && !topology.nonmanifold[index];
        const bool defined = interior && areas[v] > 0;
        const Vector3 Cx = stiffness_times_positions(all.C, mesh.X, v);   // −2HAn
        all.H[v] = defined ? (Cx.dot(sums.normal) > 0 ? -0.5 : 0.5) * Cx.norm() / areas[v] : undefined;
        all.K[v] = defined ? all.angle_deficit[v] / areas[v] : undefined;
    };
    visit_rings(mesh, topology.vertex_faces, measure,
                [&] { return [&fill, rows = StiffnessRows(all.C)](const Ring& ring) mutable { fill(ring, rows); }; });
    return all;
}

}   // namespace meshfolio
