// Smoothing of one mesh in growing sizes: explicit steps beside Eigen's product L * X, implicit ones beside Eigen's SimplicialLDLT.
#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <Eigen/SparseCholesky>

#include "bench/bench_meshes.h"
#include "geometry/measures/spatial_order.h"
#include "geometry/smoothing/diffusion_step.h"
#include "geometry/smoothing/implicit_solver.h"
#include "geometry/smoothing/laplacian_smoothing.h"

namespace {

using namespace meshfolio;

constexpr double lambda = 1e-5;   // of the area: what the peers were timed with

struct Subject {
    TriangleMesh mesh;
    LaplaceBeltrami laplacian;   // of the mesh at area 1
    double area = 1;
};

const Subject& subject_at(int level) {
    static int current = -1;
    static Subject subject;
    if (current == level) return subject;
    subject.mesh = bench::triangle_mesh(bench::mesh_at_level(level));
    subject.laplacian = laplace_beltrami(subject.mesh);
    subject.area = subject.laplacian.M.sum();
    subject.laplacian.M /= subject.area;
    current = level;
    return subject;
}

int iterations(const benchmark::State& state) { return static_cast<int>(state.range(1)); }

/// In an arena of as many threads as asked for: the arena made first would keep its size for all that follows.
template <class Body> void on_threads(const benchmark::State& state, Body body) {
    tbb::task_arena arena(static_cast<int>(state.range(2)));
    arena.execute(body);
}

void note(benchmark::State& state, const Subject& subject) {
    state.counters["vertices"] = static_cast<double>(subject.mesh.vertex_count());
}

/// L and X as Eigen's users write them: both by columns.
void explicit_eigen(benchmark::State& state) {
    const Subject& subject = subject_at(static_cast<int>(state.range(0)));
    SparseMatrix L = subject.laplacian.C;
    for (int j = 0; j < L.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) entry.valueRef() /= subject.laplacian.M[entry.row()];
    }
    for (auto _ : state) {
        DenseMatrix X = subject.mesh.X;
        for (int t = 0; t < iterations(state); ++t) {
            const DenseMatrix LX = L * X;
            X += 1e-12 * LX;
        }
        benchmark::DoNotOptimize(X.data());
    }
    note(state, subject);
}

/// The steps with the operator prepared, as Eigen's above, with positions sorted at the beginning and put back at the end.
void explicit_ours(benchmark::State& state) {
    const Subject& subject = subject_at(static_cast<int>(state.range(0)));
    const OperatorWithMass whole = operator_with_mass(subject.laplacian);
    const ExplicitDiffusion diffusion(reordered(whole, morton_order(subject.mesh.X(whole.vertex, Eigen::all))));
    for (auto _ : state) {
        FourColumns X = gathered(subject.mesh.X, diffusion.vertex()), next(X.rows(), 4);
        for (int t = 0; t < iterations(state); ++t) {
            diffusion.step(1e-12, X, next);
            std::swap(X, next);
        }
        Positions result = subject.mesh.X;
        scatter(X, diffusion.vertex(), result);
        benchmark::DoNotOptimize(result.data());
    }
    note(state, subject);
}

/// The whole of smooth(): operator, sorting, steps, the watch over what runs away.
void smooth_run(benchmark::State& state, SmoothingScheme scheme, double memory_limit) {
    const Subject& subject = subject_at(static_cast<int>(state.range(0)));
    SmoothingOptions options;
    options.scheme = scheme;
    options.lambda = scheme == SmoothingScheme::implicit_euler ? lambda * subject.area : 1e-12 * subject.area;
    options.iterations = iterations(state);
    options.memory_limit = memory_limit;
    Smoothed result;
    for (auto _ : state) result = smooth(subject.mesh, options);
    note(state, subject);
    if (scheme == SmoothingScheme::implicit_euler) state.counters["cg_iterations"] = static_cast<double>(result.solver_iterations);
}

void implicit_eigen(benchmark::State& state) {
    const Subject& subject = subject_at(static_cast<int>(state.range(0)));
    const Vector& M = subject.laplacian.M;
    SparseMatrix mass(M.size(), M.size());
    mass = M.asDiagonal();
    const SparseMatrix system = mass - lambda * subject.laplacian.C;
    for (auto _ : state) {
        const Eigen::SimplicialLDLT<SparseMatrix> factor(system);
        DenseMatrix X = subject.mesh.X;
        for (int t = 0; t < iterations(state); ++t) X = factor.solve(DenseMatrix(M.asDiagonal() * X));
        benchmark::DoNotOptimize(X.data());
    }
    note(state, subject);
}

/// What prepared positions and operator cost beyond them: sorting, analysis, factor and the steps.
void implicit_ours(benchmark::State& state, double memory_limit) {
    const Subject& subject = subject_at(static_cast<int>(state.range(0)));
    const OperatorWithMass whole = operator_with_mass(subject.laplacian);
    long long iterations_of_cg = 0;
    for (auto _ : state) {
        ImplicitSolver solver;
        solver.prepare(whole, lambda, memory_limit);
        FourColumns X = gathered(subject.mesh.X, solver.vertex());
        for (int t = 0; t < iterations(state); ++t) solver.step(X);
        Positions result = subject.mesh.X;
        scatter(X, solver.vertex(), result);
        benchmark::DoNotOptimize(result.data());
        iterations_of_cg = solver.work().iterations;
    }
    note(state, subject);
    state.counters["cg_iterations"] = static_cast<double>(iterations_of_cg);
}

template <class Run> void add(const char* name, int steps, const std::vector<std::int64_t>& threads, Run run) {
    constexpr int largest_level = 2;
    benchmark::RegisterBenchmark(name, run)
        ->ArgsProduct({benchmark::CreateDenseRange(0, largest_level, 1), {steps}, threads})
        ->ArgNames({"level", "steps", "threads"})
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

}   // namespace

int main(int count_of_arguments, char** arguments) {
    constexpr double nothing_fits = 1;   // byte
    using benchmark::State;
    add("explicit_eigen", 100, {1}, explicit_eigen);
    const auto threaded = [](auto run) { return [run](State& s) { on_threads(s, [&] { run(s); }); }; };
    add("explicit_ours", 100, {1, 2}, threaded(explicit_ours));
    add("explicit_smooth", 100, {1, 2}, threaded([](State& s) { smooth_run(s, SmoothingScheme::explicit_euler, 0); }));
    add("implicit_eigen", 10, {1}, implicit_eigen);
    add("implicit_ours", 10, {1, 2}, threaded([](State& s) { implicit_ours(s, 0); }));
    add("implicit_ours_cg", 10, {1, 2}, threaded([](State& s) { implicit_ours(s, nothing_fits); }));
    add("implicit_smooth", 10, {1, 2}, threaded([](State& s) { smooth_run(s, SmoothingScheme::implicit_euler, 0); }));
    benchmark::Initialize(&count_of_arguments, arguments);
    if (benchmark::ReportUnrecognizedArguments(count_of_arguments, arguments)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
