// The operators of one mesh in five sizes, on one thread and on two: the matrix C, three forms of M and the curvatures.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "bench/bench_meshes.h"
#include "geometry/curvature/curvature.h"

namespace {

using namespace meshfolio;

struct Subject {
    TriangleMesh mesh;
    MeshTopology topology;
    LaplaceBeltrami laplacian;
};

const Subject& subject_at(int level) {
    static int current = -1;
    static Subject subject;
    if (current == level) return subject;
    subject.mesh = bench::triangle_mesh(bench::mesh_at_level(level));
    subject.topology = topology_of(subject.mesh);
    subject.laplacian = laplace_beltrami(subject.mesh);
    current = level;
    return subject;
}

/// Times stage(subject). Arguments: level, threads.
template <class Stage> void time_stage(benchmark::State& state, Stage stage) {
    const Subject& subject = subject_at(static_cast<int>(state.range(0)));
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(state.range(1)));
    for (auto _ : state) benchmark::DoNotOptimize(stage(subject));
    using benchmark::Counter;
    const auto triangles = static_cast<double>(subject.mesh.face_count());
    state.counters["triangles"] = triangles;
    state.counters["per_triangle"] = Counter(triangles, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

template <class Stage> void add(const char* name, Stage stage) {
    benchmark::RegisterBenchmark(name, [stage](benchmark::State& state) { time_stage(state, stage); })
        ->ArgsProduct({benchmark::CreateDenseRange(0, bench::levels - 1, 1), {1, 2}})
        ->ArgNames({"level", "threads"})
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

}   // namespace

int main(int count_of_arguments, char** arguments) {
    add("topology", [](const Subject& s) { return topology_of(s.mesh); });
    add("laplace_beltrami", [](const Subject& s) { return laplace_beltrami(s.mesh); });
    add("barycentric", [](const Subject& s) { return vertex_areas(s.mesh, AreaForm::barycentric); });
    add("voronoi", [](const Subject& s) { return vertex_areas(s.mesh, AreaForm::voronoi); });
    add("mixed", [](const Subject& s) { return vertex_areas(s.mesh, AreaForm::mixed); });
    add("angle_deficit", [](const Subject& s) { return angle_deficit(s.mesh, s.topology); });
    add("cotangent_mean_curvature", [](const Subject& s) { return cotangent_mean_curvature(s.mesh, s.topology, s.laplacian); });
    benchmark::Initialize(&count_of_arguments, arguments);
    if (benchmark::ReportUnrecognizedArguments(count_of_arguments, arguments)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
