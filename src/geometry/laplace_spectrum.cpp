#include "geometry/laplace_spectrum.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "errors.h"
#include "geometry/inertia.h"
#include "geometry/spectrum_memory.h"
#include "geometry/zero_modes.h"

namespace meshfolio {

namespace {

/// y = M^½ φ: orthonormal columns, eigenvalues ascending.
struct SymmetricPairs {
    Vector mu;
    DenseMatrix Y;
    int count() const { return static_cast<int>(mu.size()); }
};

/// ‖By − μy‖ / μ for each pair, in the norm of the equations −Cφ = μMφ: ‖M^½(By − μy)‖ / (μ‖M^½y‖).
Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs) {
    Vector residuals(pairs.count());
    tbb::parallel_for(0, pairs.count(), [&](int j) {
        const Vector r = B * pairs.Y.col(j) - pairs.mu[j] * pairs.Y.col(j);
        const double size = root_mass.cwiseProduct(pairs.Y.col(j)).norm();
        residuals[j] = root_mass.cwiseProduct(r).norm() / (pairs.mu[j] > 0 ? pairs.mu[j] * size : 1);
    });
    return residuals;
}

/// The eigenvalues below `sigma`, counted by inertia and among those found.
struct InertiaCount {
    double sigma = 0;
    int counted = -1, found = -1;
};

/// The k pairs asked for, in symmetric form, zero modes first.
struct Modes {
    SymmetricPairs pairs;
    InertiaCount inertia;
    bool dense = false;
    SpectrumTimes times = {};
    int slices = 0, repairs = 0;
};

struct Gap {
    double low, high;
};
/// The first clear gap of the ascending `mu` behind its k-th entry, or what follows its last. A cluster is never cut: rounding would
/// decide on which side of σ its members are.
Gap gap_behind(const Vector& mu, int k) {
    constexpr double clear = 1e-5;
    for (Eigen::Index i = k; i < mu.size(); ++i) {
        if (mu[i] - mu[i - 1] > clear * mu[i]) return {mu[i - 1], mu[i]};
    }
    const double largest = mu[mu.size() - 1];
    return largest > 0 ? Gap{largest, 1.002 * largest} : Gap{0, 2};
}

int entries_below(const Vector& mu, double sigma) { return static_cast<int>((mu.array() < sigma).count()); }

Vector with_zeros(int zeros, const Vector& mu) {
    Vector all(zeros + mu.size());
    all << Vector::Zero(zeros), mu;
    return all;
}

/// The first k pairs of zero modes and others together.
SymmetricPairs first_pairs(const ZeroModes& zero_modes, SymmetricPairs others, int k) {
    const int zeros = std::min(zero_modes.count(), k);
    SymmetricPairs first{with_zeros(zeros, others.mu.head(k - zeros)), DenseMatrix(others.Y.rows(), k)};
    first.Y << zero_modes.first(zeros), others.Y.leftCols(k - zeros);
    return first;
}

Modes dense_modes(const SparseMatrix& A, const Vector& M, int k) {
    const ZeroModes zero_modes(A, M);
    const Eigen::SelfAdjointEigenSolver<DenseMatrix> solver{DenseMatrix(symmetric_form(A, M))};
    if (solver.info() != Eigen::Success) throw SolverError("the dense eigensolver did not converge");
    const Eigen::Index n = A.rows(), others = n - zero_modes.count();
    if (solver.eigenvalues()[0] < -1e-10 * std::abs(solver.eigenvalues()[n - 1])) {
        throw SolverError("−C has negative eigenvalues, so it is no Laplacian",
                          "repair triangles of zero area, and sum the opposite cotangents of an edge instead of averaging them");
    }
    SymmetricPairs nonzero{solver.eigenvalues().tail(others), solver.eigenvectors().rightCols(others)};
    for (Eigen::Index j = 0; j < others; ++j) {
        zero_modes.project_out(nonzero.Y.col(j));
        nonzero.Y.col(j).normalize();
    }
    Modes modes{first_pairs(zero_modes, nonzero, k), {}, true, {}, 0, 0};
    const Vector mu = with_zeros(zero_modes.count(), nonzero.mu);
    const Gap gap = gap_behind(mu, k);
    if (const auto inertia = inertia_between(A, M, gap.low, gap.high))
        modes.inertia = {inertia->sigma, inertia->below, entries_below(mu, inertia->sigma)};
    return modes;
}

Modes sliced_modes(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options) {
    // Measured with k = 1500 on 3.5 k vertices: half the time, the dense projected problems being most of it there.
    constexpr int small_mesh = 20'000, pairs_on_small_meshes = 40;
    const SpectrumProblem problem(A, M);
    const int others = std::max(0, k - problem.zeros.count());
    SliceOptions slice_options{
        .tolerance = options.polish ? std::min(options.tolerance, 1e-12) : options.tolerance,
        .polish = options.polish,
        .pairs_per_slice = A.rows() < small_mesh ? std::min(options.pairs_per_slice, pairs_on_small_meshes) : options.pairs_per_slice,
        .one_slice_up_to = options.one_slice_up_to,
        .threads = options.threads,
        .progress = options.progress};
    slice_options.threads = slices_that_fit(problem, k, slice_options, options.memory_limit);
    SlicedPairs found = find_by_slices(problem, others, slice_options);
    const InertiaProof last = found.proofs.back();
    Modes modes;
    modes.inertia = {last.sigma, last.counted, last.found};
    modes.times = found.times;
    modes.slices = found.slices;
    modes.repairs = found.repairs;
    modes.pairs = first_pairs(problem.zeros, {std::move(found.mu), std::move(found.Y)}, k);
    return modes;
}

Modes modes_of(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options) {
    const Eigen::Index n = A.rows();
    if (n <= options.dense_below) return dense_modes(A, M, k);
    return sliced_modes(A, M, k, options);
}

}   // namespace

Spectrum smallest_eigenpairs(const LaplaceBeltrami& laplacian, int k, const SpectrumOptions& options) {
    if (k < 1) throw MeshError("smallest_eigenpairs: k = " + std::to_string(k), "ask for at least one");
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const double total = whole.M.sum();
    const Vector M = whole.M / total;   // in units where the area is 1, whatever the model's
    k = std::min(k, whole.size());
    Modes modes = modes_of(whole.A, M, k, options);

    const Vector root = M.cwiseSqrt();
    Spectrum spectrum;
    spectrum.residuals = relative_residuals(symmetric_form(whole.A, M), root, modes.pairs);
    spectrum.eigenvalues = modes.pairs.mu / total;
    DenseMatrix Phi = std::move(modes.pairs.Y);   // n × k may be most of the memory: scaled where it is
    const Vector scale = (root * std::sqrt(total)).cwiseInverse();
    tbb::parallel_for(0, k, [&](int j) {
        Phi.col(j).array() *= scale.array();
        if (Phi(first_largest(Phi.col(j)), j) < 0) Phi.col(j) *= -1;
    });
    spectrum.eigenvectors = whole.size() == whole.all_vertices ? std::move(Phi) : to_all_vertices(whole, Phi);
    spectrum.dense = modes.dense;
    spectrum.inertia_count = modes.inertia.counted;
    spectrum.found_below = modes.inertia.found;
    spectrum.inertia_shift = modes.inertia.sigma / total;
    spectrum.slices = modes.slices;
    spectrum.repairs = modes.repairs;
    spectrum.times = modes.times;
    if (options.progress) options.progress(1);
    return spectrum;
}

double orthonormality_error(const Spectrum& spectrum, const Vector& M) {
    const DenseMatrix& Phi = spectrum.eigenvectors;
    const DenseMatrix gram = Phi.transpose() * (M.asDiagonal() * Phi);
    return (gram - DenseMatrix::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

}   // namespace meshfolio
