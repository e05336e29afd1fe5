#include "mesh/surface_patch.h"

#include <string>

#include "base/errors.h"

namespace meshfolio {

CompactMesh surface_patch(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int most_vertices) {
    if (vertex < 0 || vertex >= mesh.vertex_count())
        throw MeshError("surface_patch: no vertex " + std::to_string(vertex) + " among " + std::to_string(mesh.vertex_count()));
    if (mesh.vertex_count() <= most_vertices) return {mesh, Eigen::VectorXi::LinSpaced(mesh.vertex_count(), 0, mesh.vertex_count() - 1)};
    std::vector<char> inside(static_cast<std::size_t>(mesh.vertex_count()), 0);
    std::vector<int> reached{vertex};
    inside[static_cast<std::size_t>(vertex)] = 1;
    const std::size_t most = static_cast<std::size_t>(most_vertices);
    for (std::size_t next = 0; next < reached.size() && reached.size() < most; ++next) {
        for (const int* w = topology.neighbours.begin(reached[next]); w != topology.neighbours.end(reached[next]); ++w) {
            if (inside[static_cast<std::size_t>(*w)] || reached.size() >= most) continue;
            inside[static_cast<std::size_t>(*w)] = 1;
            reached.push_back(*w);
        }
    }
    std::vector<int> faces;
    for (int t = 0; t < mesh.face_count(); ++t) {
        bool all = true;
        for (const int v : mesh.F.row(t)) all = all && inside[static_cast<std::size_t>(v)];
        if (all) faces.push_back(t);
    }
    return without_unreferenced_vertices({mesh.X, mesh.F(faces, Eigen::all)});
}

}   // namespace meshfolio
