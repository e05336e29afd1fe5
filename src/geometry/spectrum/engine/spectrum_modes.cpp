#include "geometry/spectrum/engine/spectrum_modes.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/spectrum/engine/distributed_modes.h"
#include "geometry/spectrum/engine/zero_modes.h"
#include "geometry/spectrum/spectrum_memory.h"

namespace meshfolio {

namespace {

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
    const SymmetricPairs all = dense_pairs(A, M);
    const Gap gap = gap_behind(all.mu, k);
    Modes modes{{all.mu.head(k), all.Y.leftCols(k)}, {}, gap.middle(), true, {}, 0, 0};
    if (const auto inertia = trusted_between(A, M, gap))
        modes.inertia = {inertia->sigma, inertia->below, entries_below(all.mu, inertia->sigma)};
    return modes;
}

/// Largest ‖By − μy‖/μ, the relative residual in the M⁻¹ norm, over what it should be: 5e-9, or what rounding of the largest rows leaves.
/// Above 1 where needles raise ‖B‖ so far that the rounding of the basis counts, which Ritz values do not show.
double excess_of_residuals(const SpectrumProblem& problem, const SymmetricPairs& pairs) {
    const double rounding = 50 * std::numeric_limits<double>::epsilon() * problem.B.diagonal().maxCoeff();
    const Vector residuals = relative_residuals(problem.B, Vector::Ones(problem.size()), pairs);
    double excess = 0;
    for (int j = 0; j < pairs.count(); ++j) excess = std::max(excess, residuals[j] / std::clamp(rounding / pairs.mu[j], 5e-9, 5e-4));
    return excess;
}

/// y := y − (B + cI)⁻¹(By − μy), c the largest μ: an error in a mode λ is multiplied by (μ + c)/(λ + c). So noise in the highest modes,
/// which needles make large in the residual, is damped, and nothing grows to more than twice.
/// @throws SolverError if B + cI is not positive definite
SymmetricPairs damped(const SparseMatrix& A, const SpectrumProblem& problem, const Vector& M, SymmetricPairs pairs) {
    SparseMatrix shift(A.rows(), A.cols());
    shift = (pairs.mu[pairs.count() - 1] * M).asDiagonal();
    const SparseFactor factor = SparseFactor::cholesky(A + shift);
    const Vector root = M.cwiseSqrt();
    tbb::parallel_for(0, pairs.count(), [&](int j) {
        auto y = pairs.Y.col(j);
        const Vector r = problem.B * y - pairs.mu[j] * y;
        y -= root.cwiseProduct(factor.solve(Vector(root.cwiseProduct(r))));
        problem.zeros.project_out(y);
    });
    const DenseMatrix half_error = 0.5 * (pairs.Y.transpose() * pairs.Y - DenseMatrix::Identity(pairs.count(), pairs.count()));
    constexpr Eigen::Index at_a_time = 1024;   // rows, for which a copy is small
    for (Eigen::Index i = 0; i < A.rows(); i += at_a_time) {
        auto rows = pairs.Y.middleRows(i, std::min(at_a_time, A.rows() - i));
        rows -= (rows * half_error).eval();   // orthonormal again: the square of the error does not count
    }
    return pairs;
}

/// The same pairs, damped where that makes their largest residual smaller.
SymmetricPairs with_small_residuals(const SparseMatrix& A, const SpectrumProblem& problem, const Vector& M, SymmetricPairs pairs) {
    constexpr int most_steps = 3;
    double excess = excess_of_residuals(problem, pairs);
    for (int step = 0; step < most_steps && excess > 1; ++step) {
        try {
            SymmetricPairs better = damped(A, problem, M, pairs);
            const double after = excess_of_residuals(problem, better);
            if (!(after < excess)) break;
            excess = after;
            pairs = std::move(better);
        } catch (const SolverError&) {   // they stay as they are, and the residuals say so
            break;
        }
    }
    return pairs;
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
    if (last.trusted) modes.inertia = {last.sigma, last.counted, last.found};
    modes.gap_middle = found.gap_middle;
    modes.times = found.times;
    modes.slices = found.slices;
    modes.repairs = found.repairs;
    modes.pairs = first_pairs(problem.zeros, with_small_residuals(A, problem, M, {std::move(found.mu), std::move(found.Y)}), k);
    return modes;
}

}   // namespace

Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs) {
    Vector residuals(pairs.count());
    tbb::parallel_for(0, pairs.count(), [&](int j) {
        const Vector r = B * pairs.Y.col(j) - pairs.mu[j] * pairs.Y.col(j);
        const double size = root_mass.cwiseProduct(pairs.Y.col(j)).norm();
        residuals[j] = root_mass.cwiseProduct(r).norm() / (pairs.mu[j] > 0 ? pairs.mu[j] * size : 1);
    });
    return residuals;
}

Gap gap_behind(const Vector& mu, int k) {
    constexpr double clear = 1e-5;
    for (Eigen::Index i = k; i < mu.size(); ++i) {
        if (mu[i] - mu[i - 1] > clear * mu[i]) return {mu[i - 1], mu[i]};
    }
    const double largest = mu[mu.size() - 1];
    return largest > 0 ? Gap{largest, 1.002 * largest} : Gap{0, 2};
}

std::optional<Inertia> trusted_between(const SparseMatrix& A, const Vector& M, const Gap& gap, Ranks* ranks) {
    const auto inertia = inertia_between(A, M, gap.low, gap.high, ranks);
    const bool trusted = inertia && inertia->delta < std::min(inertia->sigma - gap.low, gap.high - inertia->sigma);
    return trusted ? inertia : std::nullopt;
}

SymmetricPairs dense_pairs(const SparseMatrix& A, const Vector& M) {
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
    return first_pairs(zero_modes, nonzero, static_cast<int>(n));
}

Modes modes_of(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options) {
    const Eigen::Index n = A.rows();
    if (n <= options.dense_below) return dense_modes(A, M, k);
    return options.ranks != nullptr ? distributed_modes(A, M, k, *options.ranks) : sliced_modes(A, M, k, options);
}

}   // namespace meshfolio
