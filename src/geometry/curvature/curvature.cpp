#include "geometry/curvature/curvature.h"

#include <Eigen/Geometry>
#include <array>

#include "base/at.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/triangle_shape.h"
#include "geometry/operators/uniform_laplacian.h"

namespace meshfolio {
namespace {

void require_size(const char* function, const char* what, Eigen::Index size, const TriangleMesh& mesh) {
    if (size == mesh.X.rows()) return;
    throw MeshError(
        std::string(function) + ": " + what + " of " + std::to_string(size) + " vertices for a mesh of " + std::to_string(mesh.X.rows()),
        "compute it from this mesh");
}

/// True if the one-ring is a closed disk around v.
bool is_interior(const MeshTopology& topology, int v) {
    return topology.vertex_faces.size(v) > 0 && !topology.on_boundary[at(v)] && !topology.nonmanifold[at(v)];
}

/// Returns H from Δx = −2Hn, Δx = laplacian_at(v): ½|Δx|, positive where Δx points against the normal; NaN but at interior vertices.
template <class LaplacianAt> Vector mean_curvature_from(const TriangleMesh& mesh, const MeshTopology& topology, LaplacianAt laplacian_at) {
    Vector H = Vector::Constant(mesh.X.rows(), undefined);
    const Incidence& triangles = topology.vertex_faces;
    for_each_index(mesh.vertex_count(), [&](int v) {
        if (!is_interior(topology, v)) return;
        Vector3 normal = Vector3::Zero();   // Σ (x₁ − x₀) × (x₂ − x₀) over the triangles around v
        for (const int* t = triangles.begin(v); t != triangles.end(v); ++t) {
            const Vector3 x0 = mesh.X.row(mesh.F(*t, 0)), x1 = mesh.X.row(mesh.F(*t, 1)), x2 = mesh.X.row(mesh.F(*t, 2));
            normal += (x1 - x0).cross(x2 - x0);
        }
        const Vector3 laplacian_of_x = laplacian_at(v);
        H[v] = (laplacian_of_x.dot(normal) > 0 ? -0.5 : 0.5) * laplacian_of_x.norm();
    });
    return H;
}

/// Returns uniform_mean_curvature() of a mesh without coincident vertices.
Vector uniform_H(const TriangleMesh& mesh, const MeshTopology& topology) {
    const Incidence& ring = topology.neighbours;
    return mean_curvature_from(mesh, topology, [&](int i) -> Vector3 {
        Vector3 sum = Vector3::Zero();
        for (const int* j = ring.begin(i); j != ring.end(i); ++j) sum += (mesh.X.row(*j) - mesh.X.row(i)).transpose();
        return sum / ring.size(i);
    });
}

}   // namespace

Vector uniform_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology) {
    require_size("uniform_mean_curvature", "topology", std::ssize(topology.on_boundary), mesh);
    return on_joined_vertices(mesh, topology, coincident_vertices(mesh), uniform_H);
}

Vector uniform_mean_curvature_scaled(const TriangleMesh& mesh, const MeshTopology& topology) {
    require_size("uniform_mean_curvature_scaled", "topology", std::ssize(topology.on_boundary), mesh);
    return on_joined_vertices(mesh, topology, coincident_vertices(mesh), [](const auto& joined, const auto& around) -> Vector {
        return 4 * uniform_H(joined, around).array() / mean_squared_ring_edge(joined, around).array();
    });
}

Vector cotangent_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const LaplaceBeltrami& laplacian) {
    require_size("cotangent_mean_curvature", "topology", std::ssize(topology.on_boundary), mesh);
    require_size("cotangent_mean_curvature", "operator", laplacian.M.size(), mesh);
    return on_joined_vertices(mesh, topology, laplacian.copies, [&](const auto& joined, const auto& around) {
        const Vector M = summed_at_first(laplacian.copies, laplacian.M);
        return mean_curvature_from(joined, around, [&](int i) -> Vector3 {
            if (!(M[i] > 0)) return Vector3::Constant(undefined);
            Vector3 sum = Vector3::Zero();   // Σ_j C_ij (x_j − x_i): (CX)_i without the rounding of far-away coordinates
            for (SparseMatrix::InnerIterator entry(laplacian.C, i); entry; ++entry)   // C is symmetric: column i is row i
                sum += entry.value() * (joined.X.row(entry.row()) - joined.X.row(i)).transpose();
            return sum / M[i];
        });
    });
}

Vector angle_deficit(const TriangleMesh& mesh, const MeshTopology& topology) {
    require_size("angle_deficit", "topology", std::ssize(topology.on_boundary), mesh);
    const double scale = unit_scale(mesh);
    const auto angles_of = [&](int t) {
        const TriangleShape triangle = triangle_shape(mesh, t, scale);
        return std::array{triangle.angle(0), triangle.angle(1), triangle.angle(2)};
    };
    Vector deficit = Vector::Zero(mesh.X.rows());
    in_order(mesh.face_count(), angles_of, [&](int t, const std::array<double, 3>& angles) {
        for (int k = 0; k < 3; ++k) deficit[mesh.F(t, k)] += angles[at(k)];
    });
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (topology.vertex_faces.size(v) == 0) continue;
        deficit[v] = (topology.on_boundary[at(v)] ? pi : 2 * pi) - deficit[v];
    }
    return deficit;
}

Vector gaussian_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const Vector& areas) {
    require_size("gaussian_curvature", "areas", areas.size(), mesh);
    const std::vector<VertexCopy> copies = coincident_vertices(mesh);
    return on_joined_vertices(mesh, topology, copies, [&](const auto& joined, const auto& around) {
        return gaussian_curvature(around, angle_deficit(joined, around), summed_at_first(copies, areas));
    });
}

Vector gaussian_curvature(const MeshTopology& topology, const Vector& deficits, const Vector& areas) {
    Vector K(deficits.size());
    for (int v = 0; v < K.size(); ++v) K[v] = is_interior(topology, v) && areas[v] > 0 ? deficits[v] / areas[v] : undefined;
    return K;
}

}   // namespace meshfolio
