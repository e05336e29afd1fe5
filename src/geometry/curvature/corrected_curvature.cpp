#include "geometry/curvature/corrected_curvature.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/errors.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

/// Area, twice the integral of H, and the integral of K.
struct Measures {
    double area = 0, mean = 0, gauss = 0;
    Measures& operator+=(const Measures& other) {
        area += other.area;
        mean += other.mean;
        gauss += other.gauss;
        return *this;
    }
};

/// Of one triangle. Positions enter by differences, so that far-away coordinates cost no digits.
Measures measures_of(const Eigen::Matrix3d& x, const Eigen::Matrix3d& u) {
    const Vector3 mean_normal = u.rowwise().mean();
    const Vector3 e1 = x.col(1) - x.col(0), e2 = x.col(2) - x.col(0);
    const Vector3 d1 = u.col(1) - u.col(0), d2 = u.col(2) - u.col(0);
    // Σ (u_k − u_j) × x_i with x_i = x_0 + e_i: the x_0 cancel.
    return {0.5 * mean_normal.dot(e1.cross(e2)), 0.5 * mean_normal.dot(e1.cross(d2) - e2.cross(d1)),
            0.5 * u.col(0).dot(u.col(1).cross(u.col(2)))};
}

/// The triangle's normal as corner k weights it, from the cross product a × b of the edges leaving it.
Vector3 weighted_normal(const Vector3& a, const Vector3& b, NormalWeights weights) {
    Vector3 cross = a.cross(b);
    const double size = cross.norm();
    if (!(size > 0)) return Vector3::Zero();
    switch (weights) {
        case NormalWeights::area:
            return cross;
        case NormalWeights::angle:
            return std::atan2(size, a.dot(b)) / size * cross;
        case NormalWeights::sphere:
            return cross / (a.squaredNorm() * b.squaredNorm());
    }
    return Vector3::Zero();
}

}   // namespace

CorrectedCurvature corrected_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals) {
    const int n = mesh.vertex_count();
    if (normals.rows() != n) throw MeshError("corrected_curvature: not one normal a vertex");
    if (static_cast<int>(topology.nonmanifold.size()) != n) throw MeshError("corrected_curvature: the topology is of another mesh");
    std::vector<Measures> around(static_cast<std::size_t>(n));
    for (const auto& f : mesh.F.rowwise()) {
        Eigen::Matrix3d x, u;
        for (int k = 0; k < 3; ++k) {
            x.col(k) = mesh.X.row(f[k]).transpose();
            u.col(k) = normals.row(f[k]).transpose();
        }
        const Measures measures = measures_of(x, u);
        for (int k = 0; k < 3; ++k) around[static_cast<std::size_t>(f[k])] += measures;
    }
    CorrectedCurvature curvature{Vector::Constant(n, undefined), Vector::Constant(n, undefined)};
    for (int v = 0; v < n; ++v) {
        const Measures& m = around[static_cast<std::size_t>(v)];
        if (!(m.area > 0) || topology.nonmanifold[static_cast<std::size_t>(v)]) continue;
        curvature.H[v] = m.mean / (2 * m.area);
        curvature.K[v] = m.gauss / m.area;
    }
    return curvature;
}

Positions weighted_vertex_normals(const TriangleMesh& mesh, NormalWeights weights) {
    Positions normals = Positions::Zero(mesh.X.rows(), 3);
    for (const auto& f : mesh.F.rowwise()) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 p = mesh.X.row(f[k]).transpose();
            const Vector3 a = mesh.X.row(f[(k + 1) % 3]).transpose() - p, b = mesh.X.row(f[(k + 2) % 3]).transpose() - p;
            normals.row(f[k]) += weighted_normal(a, b, weights).transpose();
        }
    }
    for (auto&& normal : normals.rowwise()) {
        const double length = normal.norm();
        if (length > 0) normal /= length;
    }
    return normals;
}

}   // namespace meshfolio
