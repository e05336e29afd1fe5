// What any renderer does that goes over the triangles once a view, and nothing more: six times {bring the vertices into the
// view, gather the corners of every triangle, signed area, drop the back sides, does the bounding box hold a pixel centre?,
// clear colour and depth}. Nothing is drawn. Built for this processor with -ffast-math: a bound, not a renderer.
#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/bench_meshes.h"

namespace {

using render::View;

struct Point {
    float x, y, z, w;
};

struct FloatMesh {
    std::vector<glm::vec3> positions;   // in pixels round the middle of the picture
    std::vector<glm::ivec3> triangles;
};

FloatMesh float_mesh(const bench::BenchMesh& mesh) {
    const render::Frame frame = render::frame_of(render::bounds_of(mesh.positions, mesh.triangles), bench::side, bench::side, 0.92);
    FloatMesh result{{}, mesh.triangles};
    for (const glm::dvec3& p : mesh.positions) result.positions.push_back(glm::vec3((p - frame.centre) * frame.pixels_per_unit));
    return result;
}

template <class Body> void in_blocks(std::size_t count, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), body, tbb::static_partitioner());
}

void transform(const FloatMesh& mesh, const View& view, std::vector<Point>& points) {
    const glm::vec3 right(view.right()), up(view.up), from(view.from);
    const float middle = 0.5F * bench::side;
    in_blocks(points.size(), [&](const auto& block) {
        for (std::size_t i = block.begin(); i < block.end(); ++i) {
            const glm::vec3& p = mesh.positions[i];
            points[i] = {middle + glm::dot(p, right), middle - glm::dot(p, up), glm::dot(p, from), 1};
        }
    });
}

/// Front triangles whose bounding box holds a pixel centre.
bool may_be_seen(const Point& a, const Point& b, const Point& c) {
    const float twice_area = (c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y);   // y points down
    if (twice_area <= 0) return false;
    const float x0 = std::min(a.x, std::min(b.x, c.x)), x1 = std::max(a.x, std::max(b.x, c.x));
    const float y0 = std::min(a.y, std::min(b.y, c.y)), y1 = std::max(a.y, std::max(b.y, c.y));
    return std::floor(x0 + 0.5F) != std::floor(x1 + 0.5F) && std::floor(y0 + 0.5F) != std::floor(y1 + 0.5F);
}

long cull(const FloatMesh& mesh, const std::vector<Point>& points) {
    const auto count = [&](const tbb::blocked_range<std::size_t>& block, long sum) {
        for (std::size_t i = block.begin(); i < block.end(); ++i) {
            const glm::ivec3& t = mesh.triangles[i];
            const auto at = [&](int vertex) -> const Point& { return points[static_cast<std::size_t>(vertex)]; };
            sum += may_be_seen(at(t.x), at(t.y), at(t.z)) ? 1 : 0;
        }
        return sum;
    };
    return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), 4096), 0L, count, std::plus<>(),
                                tbb::static_partitioner());
}

struct Pixel {
    std::uint32_t color;
    float depth;
};

void clear(std::vector<Pixel>& pixels) {
    in_blocks(pixels.size(), [&](const auto& block) {
        for (std::size_t i = block.begin(); i < block.end(); ++i) pixels[i] = {0xffffffff, 1e30F};
    });
}

void naive_bound(benchmark::State& state) {
    const FloatMesh mesh = float_mesh(bench::mesh_at_level(static_cast<int>(state.range(0))));
    std::vector<Point> points(mesh.positions.size());
    std::vector<Pixel> pixels(bench::side * bench::side);
    long seen = 0;
    for (auto _ : state) {
        seen = 0;
        for (const View& view : render::six_views) {
            transform(mesh, view, points);
            seen += cull(mesh, points);
            clear(pixels);
            benchmark::ClobberMemory();
        }
        benchmark::DoNotOptimize(seen);
    }
    state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
    state.counters["seen"] = static_cast<double>(seen) / (6.0 * static_cast<double>(mesh.triangles.size()));   // share
}

}   // namespace

BENCHMARK(naive_bound)->DenseRange(0, bench::levels - 1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
