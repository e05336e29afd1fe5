#include "geometry/curvature/corrected_curvature.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "base/at.h"
#include "base/errors.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {

CorrectedCurvature corrected_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals) {
    const int n = mesh.vertex_count();
    if (normals.rows() != n)
        throw MeshError("corrected_curvature: " + std::to_string(normals.rows()) + " normals for " + std::to_string(n) + " vertices",
                        "give one a vertex");
    if (std::ssize(topology.nonmanifold) != n)
        throw MeshError("corrected_curvature: a topology of " + std::to_string(topology.nonmanifold.size()) + " vertices for a mesh of " +
                            std::to_string(n),
                        "compute it from this mesh");
    Positions measures = Positions::Zero(n, 3);   // Σμ₀, Σμ₁, Σμ₂ over the triangles around each vertex
    for (const auto& f : mesh.F.rowwise()) {
        Eigen::Matrix3d x, u;
        for (int k = 0; k < 3; ++k) {
            x.col(k) = mesh.X.row(f[k]).transpose();
            u.col(k) = normals.row(f[k]).transpose();
        }
        const Vector3 mean_normal = u.rowwise().mean();
        const Vector3 e1 = x.col(1) - x.col(0), e2 = x.col(2) - x.col(0);
        const Vector3 d1 = u.col(1) - u.col(0), d2 = u.col(2) - u.col(0);
        // In Σ (u_k − u_j) × x_i with x_i = x_0 + e_i the x_0 cancel: far-away coordinates cost no digits.
        const Eigen::RowVector3d of_triangle(0.5 * mean_normal.dot(e1.cross(e2)), 0.5 * mean_normal.dot(e1.cross(d2) - e2.cross(d1)),
                                             0.5 * u.col(0).dot(u.col(1).cross(u.col(2))));
        for (int k = 0; k < 3; ++k) measures.row(f[k]) += of_triangle;
    }
    CorrectedCurvature curvature{Vector::Constant(n, undefined), Vector::Constant(n, undefined)};
    for (int v = 0; v < n; ++v) {
        const double area = measures(v, 0);
        if (!(area > 0) || topology.nonmanifold[at(v)]) continue;
        curvature.H[v] = measures(v, 1) / (2 * area);
        curvature.K[v] = measures(v, 2) / area;
    }
    return curvature;
}

Positions weighted_vertex_normals(const TriangleMesh& mesh, NormalWeights weights) {
    Positions normals = Positions::Zero(mesh.X.rows(), 3);
    for (const auto& f : mesh.F.rowwise()) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 p = mesh.X.row(f[k]).transpose();
            const Vector3 a = mesh.X.row(f[(k + 1) % 3]).transpose() - p, b = mesh.X.row(f[(k + 2) % 3]).transpose() - p;
            Vector3 normal = a.cross(b);
            const double size = normal.norm();
            if (!(size > 0)) continue;
            if (weights == NormalWeights::angle) normal = std::atan2(size, a.dot(b)) / size * normal;
            if (weights == NormalWeights::sphere) normal /= a.squaredNorm() * b.squaredNorm();
            normals.row(f[k]) += normal.transpose();
        }
    }
    for (auto&& normal : normals.rowwise()) {
        const double length = normal.norm();
        if (length > 0) normal /= length;
    }
    return normals;
}

}   // namespace meshfolio
