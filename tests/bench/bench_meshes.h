/// @file
/// One mesh in growing sizes, for the benchmarks.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "draw_mesh.h"

namespace meshfolio {
struct TriangleMesh;
}

namespace bench {

inline constexpr int levels = 5;    // sizes of one mesh, each four times as many triangles as the one before
inline constexpr int side = 1024;   // pixels of a picture

struct BenchMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::ivec3> triangles;
    std::vector<double> values;   // the height y of each vertex
    double low = 0, high = 1;     // of the values

    render::Surface surface() const { return {positions, triangles, values}; }
    /// What the benchmarks call one picture: 1024 × 1024, 4 samples, viridis.
    render::DrawOptions options() const {
        return {.width = side, .height = side, .range = {&render::colormap_named("viridis"), low, high}};
    }
    double bytes() const;
};

BenchMesh read_bench_mesh(const std::string& file);

meshfolio::TriangleMesh triangle_mesh(const BenchMesh& mesh);

/// Every triangle into four through its edge midpoints. Midpoints are numbered by the edges' vertices.
BenchMesh subdivided(const BenchMesh& mesh);

/// With a quarter of the vertices, and so about a quarter of the triangles.
BenchMesh quartered(const BenchMesh& mesh);

/// The file named by MESHFOLIO_BENCH_MESH, or else a bundled shape, subdivided `level` times.
const BenchMesh& mesh_at_level(int level);

}   // namespace bench
