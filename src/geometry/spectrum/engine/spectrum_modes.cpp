#include "geometry/spectrum/engine/spectrum_modes.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/linear/aligned_columns.h"
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

Modes sliced_modes(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options) {
    const SpectrumProblem problem(A, M);
    const int others = std::max(0, k - problem.zeros.count());
    SliceOptions slice_options{.tolerance = options.polish ? std::min(options.tolerance, 1e-12) : options.tolerance,
                               .polish = options.polish,
                               .pairs_per_slice = options.pairs_per_slice,
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
    modes.pairs = first_pairs(problem.zeros, {std::move(found.mu), std::move(found.Y)}, k);
    return modes;
}

}   // namespace

Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs) {
    using Eight = Eigen::Array<double, EightColumns::width, 1>;
    constexpr int width = EightColumns::width;
    Vector residuals(pairs.count());
    // Eight pairs read the matrix once.
    tbb::parallel_for(0, (pairs.count() + width - 1) / width, [&](int group) {
        const int first = width * group, columns = std::min(width, pairs.count() - first);
        EightColumns Y(B.rows());
        for (Eigen::Index i = 0; i < B.rows(); ++i) {
            for (int c = 0; c < width; ++c) Y.row(i)[c] = c < columns ? pairs.Y(i, first + c) : 0;
        }
        Eight mu = Eight::Zero(), rest = Eight::Zero(), size = Eight::Zero();
        mu.head(columns) = pairs.mu.segment(first, columns);
        for (Eigen::Index i = 0; i < B.cols(); ++i) {
            const Eigen::Map<const Eight> y(Y.row(i));
            Eight r = Eight::Zero();
            for (SparseMatrix::InnerIterator entry(B, i); entry; ++entry) r += entry.value() * Eigen::Map<const Eight>(Y.row(entry.row()));
            rest += (root_mass[i] * (r - mu * y)).square();
            size += (root_mass[i] * y).square();
        }
        for (int c = 0; c < columns; ++c) residuals[first + c] = std::sqrt(rest[c]) / (mu[c] > 0 ? mu[c] * std::sqrt(size[c]) : 1);
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
