#include "mesh/triangle_measures.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace meshfolio {

namespace {

/// Returns the position of corner k mod 3 of triangle t.
inline Vector3 corner(const TriangleMesh& mesh, int t, int k) { return mesh.X.row(mesh.F(t, k % 3)); }

/// Returns |v|, by way of a scaled v if squares would leave the range of a double. Both ways give the same digits.
inline double length(const Vector3& v) {
    const double squared = v.squaredNorm(), largest = v.cwiseAbs().maxCoeff();
    if (squared > 1e-280 && squared < 1e300) return std::sqrt(squared);
    if (!(largest > 0 && std::isfinite(largest))) return v.cwiseAbs().sum();
    const int exponent = std::ilogb(largest);
    const Vector3 scaled = v.unaryExpr([&](double x) { return std::scalbn(x, -exponent); });
    return std::scalbn(scaled.norm(), exponent);
}

inline Vector3 unit_or_zero(const Vector3& v) {
    const double norm = length(v);
    return norm > 0 ? Vector3(v / norm) : Vector3::Zero();
}

/// Returns (x₁ − x₀) × (x₂ − x₀): along the normal, twice the area long.
inline Vector3 area_vector(const TriangleMesh& mesh, int t) {
    const Vector3 x0 = corner(mesh, t, 0);
    return (corner(mesh, t, 1) - x0).cross(corner(mesh, t, 2) - x0);
}

inline void include(const Vector3& x, Box& box) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
}

}   // namespace

Box bounding_box(const TriangleMesh& mesh) {
    if (mesh.vertex_count() == 0) return {Vector3::Zero(), Vector3::Zero()};
    if (mesh.face_count() == 0) return {mesh.X.colwise().minCoeff(), mesh.X.colwise().maxCoeff()};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Box nothing{Vector3::Constant(infinity), Vector3::Constant(-infinity)};
    const auto boxes = per_block(mesh.face_count(), [&](int begin, int end) {
        Box box = nothing;
        for (int t = begin; t < end; ++t)
            for (int k = 0; k < 3; ++k) include(corner(mesh, t, k), box);
        return box;
    });
    Box box = nothing;
    for (const auto& block : boxes) {
        include(block.value.low, box);
        include(block.value.high, box);
    }
    return box;
}

CornerValues edge_lengths(const TriangleMesh& mesh) {
    CornerValues l(mesh.face_count(), 3);
    for (int t = 0; t < mesh.face_count(); ++t)
        for (int k = 0; k < 3; ++k) l(t, k) = (corner(mesh, t, k + 2) - corner(mesh, t, k + 1)).stableNorm();
    return l;
}

double mean_edge_length(const TriangleMesh& mesh) {
    const std::vector<Edge> edges = edges_of(mesh);
    return edges.empty() ? 0 : mean_edge_length(mesh, edges);
}

double mean_edge_length(const TriangleMesh& mesh, const std::vector<Edge>& edges) {
    const auto length_of = [&](int i) {
        const Edge& e = edges[static_cast<std::size_t>(i)];
        return (mesh.X.row(e.b) - mesh.X.row(e.a)).norm();
    };
    return ordered_sum(static_cast<int>(edges.size()), length_of) / static_cast<double>(edges.size());
}

CornerValues corner_angles(const TriangleMesh& mesh) {
    CornerValues angles(mesh.face_count(), 3);
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 apex = corner(mesh, t, k), u = corner(mesh, t, k + 1) - apex, v = corner(mesh, t, k + 2) - apex;
            angles(t, k) = std::atan2(length(u.cross(v)), u.dot(v));
        }
    }
    return angles;
}

Vector face_areas(const TriangleMesh& mesh) {
    Vector A(mesh.face_count());
    for_each_index(mesh.face_count(), [&](int t) { A[t] = 0.5 * length(area_vector(mesh, t)); });
    return A;
}

double surface_area(const TriangleMesh& mesh) { return face_areas(mesh).sum(); }

double signed_volume(const TriangleMesh& mesh) { return signed_volume(mesh, bounding_box(mesh).centre()); }

double signed_volume(const TriangleMesh& mesh, const Vector3& centre) {
    return ordered_sum(mesh.face_count(), [&](int t) { return six_volumes(mesh, t, centre); }) / 6;
}

double six_volumes(const TriangleMesh& mesh, int t, const Vector3& point) {
    return (corner(mesh, t, 0) - point).dot((corner(mesh, t, 1) - point).cross(corner(mesh, t, 2) - point));
}

Positions face_normals(const TriangleMesh& mesh) {
    Positions N(mesh.face_count(), 3);
    for (int t = 0; t < mesh.face_count(); ++t) N.row(t) = unit_or_zero(area_vector(mesh, t));
    return N;
}

Positions vertex_normals(const TriangleMesh& mesh) {
    Positions N = Positions::Zero(mesh.vertex_count(), 3);
    for (int t = 0; t < mesh.face_count(); ++t) {
        const Vector3 a = area_vector(mesh, t);
        for (int k = 0; k < 3; ++k) N.row(mesh.F(t, k)) += a;
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) N.row(v) = unit_or_zero(N.row(v));
    return N;
}

}   // namespace meshfolio
