#include "geometry/spectrum/engine/distributed_modes.h"

#include <algorithm>
#include <numeric>

#include "base/errors.h"
#include "geometry/distributed/ranks.h"
#include "geometry/spectrum/engine/zero_modes.h"

namespace meshfolio {

namespace {

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

}   // namespace

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
            throw SolverError(std::to_string(wanted) + " eigenpairs are counted by inertia and not found", "repair the mesh's needles");
    }
    modes.pairs = {modes.pairs.mu.head(k), modes.pairs.Y.leftCols(k)};
    return modes;
}

}   // namespace meshfolio
