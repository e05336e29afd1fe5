// spectrum_bench MESH LEVEL K: the K smallest eigenpairs of the mesh subdivided LEVEL times; prints one line of JSON with seconds (wall and
// processor), residual, orthonormality and peak memory. `export MESH LEVEL FOLDER` writes C and M for SciPy.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>

#include "bench/bench_meshes.h"
#include "bench/peak_memory.h"
#include "geometry/spectrum/laplace_spectrum.h"

using namespace meshfolio;

namespace {

double clock_seconds(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

TriangleMesh bench_mesh(const std::string& file, int level) {
    bench::BenchMesh mesh = bench::read_bench_mesh(file);
    for (int i = 0; i < level; ++i) mesh = bench::subdivided(mesh);
    return bench::triangle_mesh(mesh);
}

/// Largest ‖−Cφ − μMφ‖ / μ‖Mφ‖ over the pairs that are not constant.
double largest_residual(const LaplaceBeltrami& laplacian, const Spectrum& spectrum) {
    double largest = 0;
    for (Eigen::Index j = 1; j < spectrum.eigenvalues.size(); ++j) {
        const Vector MPhi = laplacian.M.cwiseProduct(spectrum.eigenvectors.col(j));
        const double r = (laplacian.C * spectrum.eigenvectors.col(j) + spectrum.eigenvalues[j] * MPhi).norm();
        largest = std::max(largest, r / (spectrum.eigenvalues[j] * MPhi.norm()));
    }
    return largest;
}

template <class T> void write_all(const std::string& file, const T* numbers, Eigen::Index count) {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(numbers), static_cast<std::streamsize>(sizeof(T)) * count);
    if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

void export_for_scipy(const LaplaceBeltrami& laplacian, const std::string& folder) {
    SparseMatrix C = laplacian.C;
    C.makeCompressed();
    write_all(folder + "/starts.i32", C.outerIndexPtr(), C.cols() + 1);
    write_all(folder + "/rows.i32", C.innerIndexPtr(), C.nonZeros());
    write_all(folder + "/values.f64", C.valuePtr(), C.nonZeros());
    write_all(folder + "/masses.f64", laplacian.M.data(), laplacian.M.size());
}

}   // namespace

int main(int count, char** arguments) try {
    const bool exports = count == 5 && std::string(arguments[1]) == "export";
    if (count != 4 && !exports) throw std::invalid_argument("usage: spectrum_bench MESH LEVEL K, or export MESH LEVEL FOLDER");
    char** const mesh = arguments + (exports ? 2 : 1);
    const LaplaceBeltrami laplacian = laplace_beltrami(bench_mesh(mesh[0], std::stoi(mesh[1])));
    if (exports) {
        export_for_scipy(laplacian, arguments[4]);
        return 0;
    }
    const int k = std::stoi(arguments[3]);
    Spectrum spectrum;
    double wall = 0, processor = 0;
    const double memory = bench::peak_memory_of([&] {
        wall = clock_seconds(CLOCK_MONOTONIC);
        processor = clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
        spectrum = smallest_eigenpairs(laplacian, k);
        wall = clock_seconds(CLOCK_MONOTONIC) - wall;
        processor = clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - processor;
    });
    std::printf(
        "{\"vertices\": %d, \"k\": %d, \"wall\": %.3f, \"cpu\": %.3f, \"slices\": %d, \"repairs\": %d, \"residual\": %.2e, "
        "\"orthonormality\": %.2e, \"last\": %.12g, \"memory\": %.0f}\n",
        int(laplacian.M.size()), k, wall, processor, spectrum.slices, spectrum.repairs, largest_residual(laplacian, spectrum),
        orthonormality_error(spectrum, laplacian.M), spectrum.eigenvalues[k - 1] * laplacian.M.sum(), memory);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
