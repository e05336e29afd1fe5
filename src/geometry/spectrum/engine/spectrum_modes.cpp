#include "geometry/spectrum/engine/spectrum_modes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.h"
#include "geometry/distributed/ranks.h"
#include "geometry/linear/aligned_columns.h"
#include "geometry/linear/dense_eigenpairs.h"
#include "geometry/spectrum/engine/slice_limits.h"
#include "geometry/spectrum/engine/zero_modes.h"

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
    if (last.trusted) modes.inertia = {last.sigma, last.below, last.found};
    modes.gap_middle = found.gap_middle;
    modes.times = found.times;
    modes.slices = found.slices;
    modes.repairs = found.repairs;
    modes.pairs = first_pairs(problem.zeros, {std::move(found.mu), std::move(found.Y)}, k);
    return modes;
}

/// B + 0.1 I is definite, and so far from singular that a solve keeps its digits; the other eigenvalues of a compact surface are above 10.
constexpr double least_shift = 0.1;

SymmetricPairs merged(const SymmetricPairs& known, const InversePairs& found) {
    Vector mu(known.count() + found.theta.size());
    mu << known.mu, found.theta.cwiseInverse().array() - least_shift;
    std::vector<Eigen::Index> order(static_cast<std::size_t>(mu.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return mu[a] < mu[b]; });
    SymmetricPairs all{mu(order), DenseMatrix(known.Y.rows(), mu.size())};
    for (Eigen::Index j = 0; j < mu.size(); ++j) {
        const Eigen::Index from = order[static_cast<std::size_t>(j)];
        all.Y.col(j) = from < known.count() ? known.Y.col(from) : found.Y.col(from - known.count());
    }
    return all;
}

/// With a factor that several processes hold together: Krylov–Schur on (B + 0.1 I)⁻¹, beside the zero modes; then held against the inertia
/// of A − σM in the gap behind the k-th, and looked for again beside those known as long as more are counted than were found.
/// @param A  −C, @param M  its masses, ΣM = 1
/// @throws SolverError if pairs do not converge, or are counted and not found
Modes distributed_modes(const SparseMatrix& A, const Vector& M, int k, Ranks& ranks) {
    constexpr int most_repairs = 6;
    SparseMatrix S(A.rows(), A.cols());
    S.setIdentity();
    S = symmetric_form(A, M) + least_shift * S;
    const ZeroModes zero_modes(A, M);
    const int zeros = zero_modes.count();
    Modes modes;
    modes.pairs = {Vector::Zero(zeros), zero_modes.first(zeros)};
    int wanted = k - zeros + 4 + k / 20;   // so that the gap behind the k-th is seen
    for (;; ++modes.repairs) {
        ranks.factor(S, true);
        wanted = std::clamp(wanted, 1, static_cast<int>(A.rows()) - modes.pairs.count());
        modes.pairs = merged(modes.pairs, ranks.largest_of_inverse(wanted, modes.pairs.Y));
        const Gap gap = gap_behind(modes.pairs.mu, k);
        modes.gap_middle = gap.middle();
        const auto inertia = trusted_between(A, M, gap, &ranks);
        if (!inertia) break;
        const auto below = static_cast<int>((modes.pairs.mu.array() < inertia->sigma).count());
        modes.inertia = {inertia->sigma, inertia->below, below};
        if (inertia->below <= below) break;
        wanted = inertia->below - below;
        if (modes.repairs == most_repairs)
            throw SolverError(std::to_string(wanted) + " eigenpairs are counted by inertia and not found",
                              "ask for other eigenpairs; needles and crowded eigenvalues are the usual causes");
    }
    modes.pairs = {modes.pairs.mu.head(k), modes.pairs.Y.leftCols(k)};
    return modes;
}

}   // namespace

Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs) {
    constexpr int width = EightColumns::width;
    Vector residuals(pairs.count());
    // Eight pairs read the matrix once.
    tbb::parallel_for(0, (pairs.count() + width - 1) / width, [&](int group) {
        const int first = width * group, columns = std::min(width, pairs.count() - first);
        EightColumns Y(B.rows());
        for (Eigen::Index i = 0; i < B.rows(); ++i)
            for (int c = 0; c < width; ++c) Y.row(i)[c] = c < columns ? pairs.Y(i, first + c) : 0;
        Eight mu = Eight::Zero(), rest = Eight::Zero(), size = Eight::Zero();
        mu.head(columns) = pairs.mu.segment(first, columns);
        for (Eigen::Index i = 0; i < B.cols(); ++i) {
            const ConstEightRow y(Y.row(i));
            Eight r = Eight::Zero();
            for (SparseMatrix::InnerIterator entry(B, i); entry; ++entry) r += entry.value() * ConstEightRow(Y.row(entry.row()));
            rest += (root_mass[i] * (r - mu * y)).square();
            size += (root_mass[i] * y).square();
        }
        for (int c = 0; c < columns; ++c) residuals[first + c] = std::sqrt(rest[c]) / (mu[c] > 0 ? mu[c] * std::sqrt(size[c]) : 1);
    });
    return residuals;
}

Gap gap_behind(const Vector& mu, int k) {
    constexpr double clear = 1e-5;
    for (Eigen::Index i = k; i < mu.size(); ++i)
        if (mu[i] - mu[i - 1] > clear * mu[i]) return {mu[i - 1], mu[i]};
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
    const DenseEigenpairs pairs = dense_eigenpairs(symmetric_form(A, M));
    const Eigen::Index n = A.rows(), others = n - zero_modes.count();
    if (pairs.values[0] < -1e-10 * std::abs(pairs.values[n - 1])) {
        throw SolverError("−C has negative eigenvalues, so it is no Laplacian",
                          "repair triangles of zero area, and sum the opposite cotangents of an edge instead of averaging them");
    }
    SymmetricPairs nonzero{pairs.values.tail(others), pairs.vectors.rightCols(others)};
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
