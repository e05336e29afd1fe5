#include "mesh/triangle_mesh.h"

#include <utility>
#include <vector>

#include "base/at.h"
#include "base/errors.h"

namespace meshfolio {

TriangleMesh moved_to(TriangleMesh mesh, Positions X) {
    if (X.rows() != mesh.X.rows())
        throw MeshError("moved_to: " + std::to_string(X.rows()) + " positions for " + std::to_string(mesh.X.rows()) + " vertices",
                        "give one a vertex");
    mesh.X = std::move(X);
    return mesh;
}

CompactMesh without_unreferenced_vertices(const TriangleMesh& mesh) {
    std::vector<int> new_index(at(mesh.vertex_count()), -1);
    for (const int v : mesh.F.reshaped()) new_index[at(v)] = 0;
    std::vector<int> original;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (new_index[at(v)] < 0) continue;
        new_index[at(v)] = static_cast<int>(original.size());
        original.push_back(v);
    }
    return {{mesh.X(original, Eigen::all), mesh.F.unaryExpr([&](int v) { return new_index[at(v)]; })},
            Eigen::Map<const Eigen::VectorXi>(original.data(), static_cast<Eigen::Index>(original.size()))};
}

}   // namespace meshfolio
