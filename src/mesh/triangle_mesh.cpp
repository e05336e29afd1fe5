#include "mesh/triangle_mesh.h"

#include <utility>
#include <vector>

#include "base/errors.h"

namespace meshfolio {

TriangleMesh moved_to(TriangleMesh mesh, Positions X) {
    if (X.rows() != mesh.X.rows())
        throw MeshError("moved_to: " + std::to_string(X.rows()) + " positions for " + std::to_string(mesh.X.rows()) + " vertices");
    mesh.X = std::move(X);
    return mesh;
}

CompactMesh without_unreferenced_vertices(const TriangleMesh& mesh) {
    std::vector<int> renamed(static_cast<std::size_t>(mesh.vertex_count()), -1);
    for (const int v : mesh.F.reshaped()) renamed[static_cast<std::size_t>(v)] = 0;
    int used = 0;
    for (int& name : renamed)
        if (name == 0) name = used++;
    CompactMesh compact;
    compact.mesh.X.resize(used, 3);
    compact.original.resize(used);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const int name = renamed[static_cast<std::size_t>(v)];
        if (name < 0) continue;
        compact.mesh.X.row(name) = mesh.X.row(v);
        compact.original[name] = v;
    }
    compact.mesh.F = mesh.F.unaryExpr([&](int v) { return renamed[static_cast<std::size_t>(v)]; });
    return compact;
}

}   // namespace meshfolio
