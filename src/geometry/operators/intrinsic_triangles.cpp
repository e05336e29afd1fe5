#include "geometry/operators/intrinsic_triangles.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "base/errors.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

std::vector<SideOfEdge> sides_by_edge(const Faces& F) {
    std::vector<SideOfEdge> sides;
    sides.reserve(3 * static_cast<std::size_t>(F.rows()));
    for (int t = 0; t < F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int from = F(t, (k + 1) % 3), to = F(t, (k + 2) % 3);
            sides.push_back({std::min(from, to), std::max(from, to), 3 * t + k, from < to});
        }
    }
    std::sort(sides.begin(), sides.end(),
              [](const SideOfEdge& a, const SideOfEdge& b) { return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side); });
    return sides;
}

IntrinsicTriangles intrinsic_triangles(const TriangleMesh& mesh) {
    IntrinsicTriangles triangles{mesh.F, edge_lengths(mesh), {}, mesh.vertex_count()};
    triangles.glued_to.assign(3 * static_cast<std::size_t>(mesh.F.rows()), IntrinsicTriangles::not_glued);
    const std::vector<SideOfEdge> sides = sides_by_edge(mesh.F);
    const auto same_edge = [](const SideOfEdge& a, const SideOfEdge& b) { return a.low == b.low && a.high == b.high; };
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = std::find_if_not(first, sides.end(), [&](const SideOfEdge& s) { return same_edge(s, *first); });
        if (last - first == 2 && first[0].ascending != first[1].ascending) {
            triangles.glued_to[static_cast<std::size_t>(first[0].side)] = first[1].side;
            triangles.glued_to[static_cast<std::size_t>(first[1].side)] = first[0].side;
        }
        first = last;
    }
    return triangles;
}

void require_corner_values(const std::string& function, const Faces& F, int vertex_count, const CornerValues& values) {
    if (values.rows() != F.rows()) {
        throw MeshError(function + ": corner values for " + std::to_string(values.rows()) + " triangles, but there are " +
                        std::to_string(F.rows()));
    }
    if (F.rows() > 0 && (F.minCoeff() < 0 || F.maxCoeff() >= vertex_count)) {
        throw MeshError(function + ": a triangle names vertex " + std::to_string(F.minCoeff() < 0 ? F.minCoeff() : F.maxCoeff()) + " of " +
                        std::to_string(vertex_count));
    }
}

void require_lengths(const std::string& function, const CornerValues& lengths) {
    for (Eigen::Index t = 0; t < lengths.rows(); ++t)
        if (!lengths.row(t).allFinite() || lengths.row(t).minCoeff() < 0)
            throw MeshError(function + ": triangle " + std::to_string(t) + " has an edge length that is negative or not finite");
}

}   // namespace meshfolio
