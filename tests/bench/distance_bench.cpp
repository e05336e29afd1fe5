// The Hausdorff distance of a mesh from what strong smoothing leaves of it, and the ratio to a search for every vertex.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "bench/bench_meshes.h"
#include "geometry/measures/closest_point.h"
#include "geometry/measures/hausdorff.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/triangle_measures.h"

namespace {

using namespace meshfolio;

struct Pair {
    TriangleMesh mesh, blob;
};

/// Five implicit steps of 100 squared mean edges.
Pair pair_at(int level) {
    const TriangleMesh mesh = bench::triangle_mesh(bench::mesh_at_level(level));
    SmoothingOptions options;
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = 100 * std::pow(mean_edge_length(mesh), 2);
    options.iterations = 5;
    return {mesh, moved_to(mesh, smooth(mesh, options).X)};
}

double farthest_of_all(const TriangleMesh& from, const TriangleMesh& to) {
    const ClosestPoint surface(to);
    double farthest = 0;
    for (Eigen::Index i = 0; i < from.X.rows(); ++i) farthest = std::max(farthest, surface.squared_distance(from.X.row(i)));
    return std::sqrt(farthest);
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void hausdorff(benchmark::State& state) {
    const Pair pair = pair_at(static_cast<int>(state.range(0)));
    const double before = cpu_seconds();
    const double expected = std::max(farthest_of_all(pair.mesh, pair.blob), farthest_of_all(pair.blob, pair.mesh));
    const double start = cpu_seconds();
    for (auto _ : state) {
        const HausdorffDistance found = hausdorff_distance(pair.mesh, pair.blob);
        if (!(found.bound >= expected)) state.SkipWithError("less than the distance of a vertex");
        benchmark::DoNotOptimize(found);
    }
    const double seconds = (cpu_seconds() - start) / static_cast<double>(state.iterations());
    state.counters["triangles"] = pair.mesh.face_count();
    state.counters["every_vertex_over_ours"] = (start - before) / seconds;
}

BENCHMARK(hausdorff)->DenseRange(0, bench::levels - 1)->ArgName("level")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}   // namespace

BENCHMARK_MAIN();
