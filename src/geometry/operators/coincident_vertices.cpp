#include "geometry/operators/coincident_vertices.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/parallel.h"
#include "geometry/operators/triangle_shape.h"
#include "mesh/disjoint_sets.h"

namespace meshfolio {
namespace {

using Corners = std::array<Vector3, 3>;

/// Calls join(k, l) for the corners at the ends of each edge without length.
template <class Join> void for_each_edge_without_length(const Corners& x, double longest_squared, Join join) {
    const double a = (x[2] - x[1]).squaredNorm(), b = (x[0] - x[2]).squaredNorm(), c = (x[1] - x[0]).squaredNorm();
    const double longest = std::max({a, b, c});
    // Most triangles are clear from squares alone, far from the ends of the range of a double.
    if (longest > 1e-200 && std::min({a, b, c}) > std::max(no_area, longest_squared) * longest) return;

    const Vector3 u = x[1] - x[0], v = x[2] - x[0];
    const double extent = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
    const double unit = extent > 0 ? extent : 1;
    const TriangleShape shape = triangle_shape(Vector3::Zero(), u / unit, v / unit);
    const double share = shape.degenerate() ? std::max(no_area, longest_squared) : longest_squared;
    for (std::size_t k = 0; k < 3; ++k)
        if (shape.squared_edge[k] <= share * shape.longest_squared_edge()) join((k + 1) % 3, (k + 2) % 3);
}

}   // namespace

std::vector<VertexCopy> coincident_vertices(const TriangleMesh& mesh, double longest) {
    const double longest_squared = longest * longest;
    const auto joined_in = per_block(mesh.face_count(), [&](int begin, int end) {
        std::vector<std::pair<int, int>> pairs;
        for (int t = begin; t < end; ++t) {
            const Corners x{mesh.X.row(mesh.F(t, 0)), mesh.X.row(mesh.F(t, 1)), mesh.X.row(mesh.F(t, 2))};
            for_each_edge_without_length(x, longest_squared, [&](std::size_t k, std::size_t l) {
                pairs.emplace_back(mesh.F(t, static_cast<int>(k)), mesh.F(t, static_cast<int>(l)));
            });
        }
        return pairs;
    });
    if (std::ranges::all_of(joined_in, [](const auto& block) { return block.value.empty(); })) return {};
    DisjointSets classes(mesh.vertex_count());
    for (const auto& block : joined_in)
        for (const auto& [a, b] : block.value) classes.join(a, b);
    const auto stays = [&](const auto& face) {
        const int a = classes.find(face[0]), b = classes.find(face[1]), c = classes.find(face[2]);
        return a != b && b != c && c != a;
    };
    const auto faces = mesh.F.rowwise();
    // A strip a hundred million times as long as wide is a strip, not a line.
    if (std::none_of(faces.begin(), faces.end(), stays)) return {};
    std::vector<VertexCopy> copies;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (const int first = classes.find(v); first != v) copies.push_back({v, first});
    return copies;
}

void share_equally(const std::vector<VertexCopy>& copies, Vector& masses) {
    Vector members = Vector::Ones(masses.size());
    for (const VertexCopy& copy : copies) members[copy.of] += 1;
    masses.array() /= members.array();
    spread(copies, masses);
}

Vector summed_at_first(const std::vector<VertexCopy>& copies, Vector masses) {   // NOLINT(performance-unnecessary-value-param): returned
    for (const VertexCopy& copy : copies) {
        masses[copy.of] += masses[copy.vertex];
        masses[copy.vertex] = 0;
    }
    return masses;
}

TriangleMesh with_joined_vertices(const TriangleMesh& mesh, const std::vector<VertexCopy>& copies) {
    Eigen::VectorXi first = Eigen::VectorXi::LinSpaced(mesh.vertex_count(), 0, mesh.vertex_count() - 1);
    for (const VertexCopy& copy : copies) first[copy.vertex] = copy.of;
    TriangleMesh joined{mesh.X, Faces(mesh.F.rows(), 3)};
    Eigen::Index kept = 0;
    for (const auto& face : mesh.F.rowwise()) {
        const Eigen::RowVector3i corners(first[face[0]], first[face[1]], first[face[2]]);
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) joined.F.row(kept++) = corners;
    }
    joined.F.conservativeResize(kept, 3);
    return joined;
}

}   // namespace meshfolio
