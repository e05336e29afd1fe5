// spectrum_bench ours|spectra MESH LEVEL K: the K smallest eigenpairs of the mesh subdivided LEVEL times; prints one line of JSON with
// seconds (wall and processor), what they were spent on, residual, orthonormality and peak memory. Spectra: shift-invert Lanczos with
// 2K vectors over Eigen's SimplicialLDLT, which of all solvers is the fastest for one right-hand side at these sizes; its tolerance is
// the largest power of ten, at most 1e-8, whose residuals are below 1e-8 as ours are. Only that run is timed.
// `export MESH LEVEL FOLDER` writes C and M for SciPy.
#include <Spectra/SymEigsShiftSolver.h>

#include <Eigen/SparseCholesky>
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

/// (A − σM)⁻¹ with M's square root on both sides, timed.
class ShiftInvert {
public:
    using Scalar = double;
    explicit ShiftInvert(const SparseMatrix& B) : B_(B) {}
    Eigen::Index rows() const { return B_.rows(); }
    Eigen::Index cols() const { return B_.cols(); }
    void set_shift(double sigma) {
        const double start = clock_seconds(CLOCK_MONOTONIC);
        solver_.setShift(-sigma);
        solver_.compute(B_);
        factor += clock_seconds(CLOCK_MONOTONIC) - start;
    }
    void perform_op(const double* x, double* y) const {
        const double start = clock_seconds(CLOCK_MONOTONIC);
        Eigen::Map<Vector>(y, rows()) = solver_.solve(Eigen::Map<const Vector>(x, rows()));
        solve += clock_seconds(CLOCK_MONOTONIC) - start;
    }
    double factor = 0;
    mutable double solve = 0;

private:
    const SparseMatrix& B_;
    Eigen::SimplicialLDLT<SparseMatrix> solver_;
};

struct Result {
    Vector eigenvalues;
    DenseMatrix vectors;
    SpectrumTimes times;
    int slices = 0, repairs = 0;
};

Result by_spectra(const LaplaceBeltrami& laplacian, int k, double tolerance) {
    const Vector M = laplacian.M / laplacian.M.sum(), scale = M.cwiseSqrt().cwiseInverse();
    SparseMatrix B = -laplacian.C;
    for (int j = 0; j < B.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(B, j); entry; ++entry) entry.valueRef() *= scale[entry.row()] * scale[j];
    }
    ShiftInvert op(B);
    Spectra::SymEigsShiftSolver<ShiftInvert> solver(op, k, std::max(20, 2 * k), -1e-3);
    solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, 1000, tolerance);
    if (solver.info() != Spectra::CompInfo::Successful) throw std::runtime_error("Spectra did not converge");
    Result result;
    result.eigenvalues = solver.eigenvalues().reverse() / laplacian.M.sum();
    result.vectors = scale.asDiagonal() * solver.eigenvectors().rowwise().reverse() / std::sqrt(laplacian.M.sum());
    result.times.factor = op.factor;
    result.times.solve = op.solve;
    return result;
}

Result by_us(const LaplaceBeltrami& laplacian, int k) {
    Spectrum spectrum = smallest_eigenpairs(laplacian, k);
    if (spectrum.inertia_count != spectrum.found_below) throw std::runtime_error("inertia does not agree");
    return {spectrum.eigenvalues, std::move(spectrum.eigenvectors), spectrum.times, spectrum.slices, spectrum.repairs};
}

/// Largest ‖−Cφ − μMφ‖ / μ‖Mφ‖ over the pairs that are not constant.
double largest_residual(const LaplaceBeltrami& laplacian, const Result& result) {
    double largest = 0;
    for (Eigen::Index j = 1; j < result.eigenvalues.size(); ++j) {
        const Vector MPhi = laplacian.M.cwiseProduct(result.vectors.col(j));
        const double r = (laplacian.C * result.vectors.col(j) + result.eigenvalues[j] * MPhi).norm();
        largest = std::max(largest, r / (result.eigenvalues[j] * MPhi.norm()));
    }
    return largest;
}

template <class T>
void write_all(const std::string& file, const T* numbers, Eigen::Index count) {
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
    if (count < 5) throw std::invalid_argument("usage: spectrum_bench ours|spectra MESH LEVEL K, or export MESH LEVEL FOLDER");
    const std::string way = arguments[1];
    const LaplaceBeltrami laplacian = laplace_beltrami(bench_mesh(arguments[2], std::stoi(arguments[3])));
    if (way == "export") {
        export_for_scipy(laplacian, arguments[4]);
        return 0;
    }
    const int k = std::stoi(arguments[4]);
    Result result;
    double wall = 0, processor = 0, memory = 0, residual = 1;
    for (double tolerance = 1e-8; residual > 1e-8 && tolerance > 1e-12; tolerance *= 0.1) {
        memory = bench::peak_memory_of([&] {
            wall = clock_seconds(CLOCK_MONOTONIC);
            processor = clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
            result = way == "ours" ? by_us(laplacian, k) : by_spectra(laplacian, k, tolerance);
            wall = clock_seconds(CLOCK_MONOTONIC) - wall;
            processor = clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - processor;
        });
        residual = largest_residual(laplacian, result);
    }
    Spectrum measured;
    measured.eigenvectors = result.vectors;
    std::printf(
        "{\"vertices\": %d, \"k\": %d, \"wall\": %.3f, \"cpu\": %.3f, \"factor\": %.3f, \"solve\": %.3f, \"orthogonalise\": %.3f, "
        "\"rayleigh_ritz\": %.3f, \"slices\": %d, \"repairs\": %d, \"residual\": %.2e, \"orthonormality\": %.2e, \"last\": %.12g, "
        "\"memory\": %.0f}\n",
        int(laplacian.M.size()), k, wall, processor, result.times.factor, result.times.solve, result.times.orthogonalise,
        result.times.rayleigh_ritz, result.slices, result.repairs, residual, orthonormality_error(measured, laplacian.M),
        result.eigenvalues[k - 1] * laplacian.M.sum(), memory);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
