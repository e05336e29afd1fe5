#include "bench/bench_meshes.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "mesh/decimation.h"
#include "mesh/io/mesh_files.h"

namespace bench {

namespace {

/// An edge of triangle `corner / 3`, opposite its corner `corner % 3`; the key is the same from both sides.
struct Edge {
    std::uint64_t key;
    std::uint32_t corner;
    friend bool operator<(const Edge& a, const Edge& b) { return a.key < b.key; }
};

std::vector<Edge> sorted_edges(const std::vector<glm::ivec3>& triangles) {
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const glm::ivec3& t : triangles)
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax({t[(k + 1) % 3], t[(k + 2) % 3]});
            const std::uint64_t key = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
            edges.push_back({key, static_cast<std::uint32_t>(edges.size())});
        }
    std::sort(edges.begin(), edges.end());
    return edges;
}

void set_values(BenchMesh& mesh) {
    mesh.values.clear();
    for (const glm::dvec3& p : mesh.positions) mesh.values.push_back(p.y);
    const auto [low, high] = std::minmax_element(mesh.values.begin(), mesh.values.end());
    mesh.low = *low;
    mesh.high = *high;
}

}   // namespace

double BenchMesh::bytes() const {
    return static_cast<double>(positions.size() * (sizeof positions[0] + sizeof values[0]) + triangles.size() * sizeof triangles[0]);
}

BenchMesh bench_mesh(const meshfolio::TriangleMesh& read) {
    BenchMesh mesh;
    for (const auto& p : read.X.rowwise()) mesh.positions.push_back({p[0], p[1], p[2]});
    for (const auto& t : read.F.rowwise()) mesh.triangles.push_back({t[0], t[1], t[2]});
    set_values(mesh);
    return mesh;
}

BenchMesh read_bench_mesh(const std::string& file) { return bench_mesh(meshfolio::read_mesh(file).mesh); }

meshfolio::TriangleMesh triangle_mesh(const BenchMesh& mesh) {
    meshfolio::TriangleMesh result;
    result.X.resize(static_cast<Eigen::Index>(mesh.positions.size()), 3);
    result.F.resize(static_cast<Eigen::Index>(mesh.triangles.size()), 3);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (int c = 0; c < 3; ++c) result.X(static_cast<Eigen::Index>(i), c) = mesh.positions[i][c];
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (int c = 0; c < 3; ++c) result.F(static_cast<Eigen::Index>(i), c) = mesh.triangles[i][c];
    }
    return result;
}

BenchMesh subdivided(const BenchMesh& mesh) {
    BenchMesh fine{mesh.positions, {}, {}};
    std::vector<glm::ivec3> middle(mesh.triangles.size());   // of the edge opposite each corner
    std::uint64_t last = ~std::uint64_t{0};
    for (const Edge& edge : sorted_edges(mesh.triangles)) {
        if (edge.key != last) fine.positions.push_back(0.5 * (mesh.positions[edge.key >> 32] + mesh.positions[edge.key & 0xffffffff]));
        last = edge.key;
        middle[edge.corner / 3][static_cast<int>(edge.corner % 3)] = static_cast<int>(fine.positions.size()) - 1;
    }
    fine.triangles.reserve(4 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::ivec3 &t = mesh.triangles[i], &m = middle[i];
        fine.triangles.insert(fine.triangles.end(), {{t.x, m.z, m.y}, {m.z, t.y, m.x}, {m.y, m.x, t.z}, m});
    }
    set_values(fine);
    return fine;
}

BenchMesh quartered(const BenchMesh& mesh) {
    return bench_mesh(meshfolio::decimated(triangle_mesh(mesh), static_cast<int>(mesh.positions.size() / 4)));
}

const BenchMesh& mesh_at_level(int level) {
    static int current = -1;
    static BenchMesh mesh;
    if (current < 0 || current > level) {
        const char* file = std::getenv("MESHFOLIO_BENCH_MESH");
        mesh = read_bench_mesh(file != nullptr ? file : MESHFOLIO_SOURCE_DIR "/data/creature.obj");
        // The bundled shapes are small: they start at about 50 000 triangles, and end at 12 million.
        if (file == nullptr) mesh = subdivided(mesh);
        current = 0;
    }
    for (; current < level; ++current) mesh = subdivided(mesh);
    return mesh;
}

}   // namespace bench
