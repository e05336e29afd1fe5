// Six views of one mesh in five sizes: mesh in memory → six finished 8-bit pictures, on two threads.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "bench/bench_meshes.h"
#include "bench/peak_memory.h"
#include "png/png.h"

namespace {

using bench::BenchMesh;
using render::six_views;

/// Time per triangle, and per pixel of all six pictures.
void count(benchmark::State& state, const BenchMesh& mesh) {
    using benchmark::Counter;
    const auto time_per = [](double things) { return Counter(things, Counter::kIsIterationInvariantRate | Counter::kInvert); };
    state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
    state.counters["per_triangle"] = time_per(static_cast<double>(mesh.triangles.size()));
    state.counters["per_pixel"] = time_per(6.0 * bench::side * bench::side);
}

void draw(benchmark::State& state, const render::DrawOptions& options) {
    const BenchMesh& mesh = bench::mesh_at_level(static_cast<int>(state.range(0)));
    const auto six_pictures = [&] { benchmark::DoNotOptimize(render::draw_views(mesh.surface(), six_views, options)); };
    const double peak = bench::peak_memory_of(six_pictures);
    for (auto _ : state) six_pictures();
    count(state, mesh);
    state.counters["mesh_MB"] = 1e-6 * mesh.bytes();
    state.counters["peak_MB"] = 1e-6 * peak;   // above the mesh; the six pictures are 25 of them
}

render::DrawOptions options_of(const benchmark::State& state) { return bench::mesh_at_level(static_cast<int>(state.range(0))).options(); }

void draw_six_views(benchmark::State& state) {
    render::DrawOptions options = options_of(state);
    options.occlusion = false;
    draw(state, options);
}

void draw_six_views_occluded(benchmark::State& state) { draw(state, options_of(state)); }

void encode_png(benchmark::State& state) {
    const BenchMesh& mesh = bench::mesh_at_level(0);
    const render::Image picture = render::draw_views(mesh.surface(), std::span(six_views).last(1), mesh.options()).front();
    std::size_t bytes = 0;
    for (auto _ : state) bytes = render::encode_png(picture).size();
    state.counters["bytes"] = static_cast<double>(bytes);
}

}   // namespace

BENCHMARK(draw_six_views)->DenseRange(0, bench::levels - 1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(draw_six_views_occluded)->DenseRange(0, bench::levels - 1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(encode_png)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

int main(int count_of_arguments, char** arguments) {
    const tbb::global_control two_threads(tbb::global_control::max_allowed_parallelism, 2);
    benchmark::Initialize(&count_of_arguments, arguments);
    if (benchmark::ReportUnrecognizedArguments(count_of_arguments, arguments)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
