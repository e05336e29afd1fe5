#include "mesh/triangle_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meshfolio {

namespace {

Vector3 corner(const TriangleMesh& mesh, Eigen::Index t, int k) { return mesh.X.row(mesh.F(t, k % 3)); }

/// (x₁ − x₀) × (x₂ − x₀): along the normal, twice the area long. [length²]
Vector3 cross_product(const TriangleMesh& mesh, Eigen::Index t) {
    const Vector3 origin = corner(mesh, t, 0);
    return (corner(mesh, t, 1) - origin).cross(corner(mesh, t, 2) - origin);
}

/// n/|n|, also where |n|² would underflow; zero for zero.
Vector3 direction_of(const Vector3& n) {
    const double largest = n.cwiseAbs().maxCoeff();
    return largest > 0 ? Vector3((n / largest).normalized()) : Vector3(0, 0, 0);
}

}   // namespace

Box bounding_box(const TriangleMesh& mesh) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Box box{Vector3::Constant(infinity), Vector3::Constant(-infinity)};
    const auto include = [&](Eigen::Index v) {
        const Vector3 x = mesh.X.row(v);
        box.low = box.low.cwiseMin(x);
        box.high = box.high.cwiseMax(x);
    };
    for (const int v : mesh.F.reshaped()) include(v);
    if (mesh.F.rows() == 0) {
        for (Eigen::Index v = 0; v < mesh.X.rows(); ++v) include(v);
    }
    if (mesh.X.rows() == 0) box = {Vector3::Zero(), Vector3::Zero()};
    return box;
}

CornerValues edge_lengths(const TriangleMesh& mesh) {
    CornerValues lengths(mesh.F.rows(), 3);
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) lengths(t, k) = (corner(mesh, t, k + 2) - corner(mesh, t, k + 1)).norm();
    }
    return lengths;
}

double mean_edge_length(const TriangleMesh& mesh) {
    std::vector<std::pair<int, int>> edges;
    edges.reserve(static_cast<std::size_t>(mesh.F.size()));
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(mesh.F(t, k), mesh.F(t, (k + 1) % 3)));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    if (edges.empty()) return 0;
    double sum = 0;
    for (const auto& [a, b] : edges) sum += (mesh.X.row(a) - mesh.X.row(b)).norm();
    return sum / static_cast<double>(edges.size());
}

CornerValues corner_angles(const TriangleMesh& mesh) {
    CornerValues angles(mesh.F.rows(), 3);
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 u = corner(mesh, t, k + 1) - corner(mesh, t, k), v = corner(mesh, t, k + 2) - corner(mesh, t, k);
            angles(t, k) = std::atan2(u.cross(v).norm(), u.dot(v));
        }
    }
    return angles;
}

Vector face_areas(const TriangleMesh& mesh) {
    Vector areas(mesh.F.rows());
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) areas[t] = 0.5 * cross_product(mesh, t).norm();
    return areas;
}

double surface_area(const TriangleMesh& mesh) { return face_areas(mesh).sum(); }

double signed_volume(const TriangleMesh& mesh) {
    const Vector3 centre = bounding_box(mesh).centre();
    double six_volumes = 0;
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        six_volumes += (corner(mesh, t, 0) - centre).dot((corner(mesh, t, 1) - centre).cross(corner(mesh, t, 2) - centre));
    }
    return six_volumes / 6;
}

Positions face_normals(const TriangleMesh& mesh) {
    Positions normals(mesh.F.rows(), 3);
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) normals.row(t) = direction_of(cross_product(mesh, t));
    return normals;
}

Positions vertex_normals(const TriangleMesh& mesh) {
    Positions normals = Positions::Zero(mesh.X.rows(), 3);
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        const Eigen::RowVector3d weighted = cross_product(mesh, t);
        for (int k = 0; k < 3; ++k) normals.row(mesh.F(t, k)) += weighted;
    }
    for (Eigen::Index v = 0; v < normals.rows(); ++v) normals.row(v) = direction_of(normals.row(v));
    return normals;
}

}   // namespace meshfolio
