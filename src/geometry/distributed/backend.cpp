#include "geometry/distributed/backend.h"

#include <algorithm>

#include "base/errors.h"
#include "geometry/distributed/ranks.h"
#include "geometry/linear/random_numbers.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/engine/spectrum_modes.h"

namespace meshfolio {
namespace {

/// Counts the eigenvalues below σ by the factor of the ranks, with a measured δ. With ET, T = (S + E)⁻¹S, in place of E, ‖E‖ ≤ 2‖ET‖ unless
/// an eigenvalue lies within δ. One of ten random vectors shows at least a tenth of a norm: Halko, Martinsson & Tropp 2011, lemma 4.1.
Inertia measured_inertia(Ranks& ranks, const SparseMatrix& A, const Vector& M, double sigma) {
    constexpr int probes = 10;
    constexpr double roundings = 10 * epsilon / 2;   // of a row's product, seven entries long or so
    const SparseMatrix S = A + SparseMatrix((-sigma * M).asDiagonal()), sizes = S.cwiseAbs();
    const Vector root = M.cwiseSqrt();
    ranks.factor(S, false);
    const int below = ranks.negative_pivots();
    std::uint64_t seed = 1;
    double largest = 0;
    for (int probe = 0; probe < probes; ++probe) {
        Vector x(M.size());
        for (double& number : x) number = std::sqrt(12.0) * uniform_number(seed);
        const Vector b = S * x.cwiseQuotient(root);
        x = ranks.solve(b);
        const Vector size = sizes * x.cwiseAbs() + b.cwiseAbs();
        largest = std::max(largest, ((b - S * x).cwiseAbs() + roundings * size).cwiseQuotient(root).norm());
    }
    // Forming a − σm rounds by u|a − σm| and by u|σ|m.
    const double forming = epsilon * (std::abs(sigma) + S.diagonal().cwiseAbs().cwiseQuotient(M).maxCoeff());
    return {sigma, below, 20 * largest + forming, true};
}

/// B + 0.1 I is definite, and far enough from singular for accurate solves; the other eigenvalues of a compact surface are above 10.
constexpr double least_shift = 0.1;

/// Computes the k smallest pairs of a connected operator by the ranks.
/// @param A  −C, @param M  its masses, ΣM = 1
/// @throws SolverError if pairs do not converge, or are counted and not found
Modes distributed_modes(const SparseMatrix& A, const Vector& M, int k, Ranks& ranks, const InertiaAt& inertia_at) {
    constexpr int most_repairs = 6;
    SparseMatrix S(A.rows(), A.cols());
    S.setIdentity();
    S = symmetric_form(A, M) + least_shift * S;
    Modes modes;
    modes.pairs = {Vector::Zero(1), M.cwiseSqrt().normalized()};
    int wanted = k + 3 + k / 20;   // so that the gap above the k-th is seen
    for (;; ++modes.repairs) {
        ranks.factor(S, true);
        wanted = std::clamp(wanted, 1, static_cast<int>(A.rows()) - modes.pairs.count());
        const InversePairs found = ranks.largest_of_inverse(wanted, modes.pairs.Y);
        modes.pairs = merged(modes.pairs, {found.theta.cwiseInverse().array() - least_shift, found.Y});
        const Gap gap = gap_behind(modes.pairs.mu, k);
        modes.gap_middle = gap.middle();
        const auto inertia = inertia_between(A, M, gap.low, gap.high, inertia_at);
        if (!inertia || !(inertia->delta < std::min(inertia->sigma - gap.low, gap.high - inertia->sigma))) break;
        wanted = inertia->below - modes.pairs.count_below(inertia->sigma);
        if (wanted <= 0) break;
        if (modes.repairs == most_repairs)
            throw SolverError(std::to_string(wanted) + " eigenpairs are counted by inertia and not found",
                              "ask for other eigenpairs; needles and crowded eigenvalues are the usual causes");
    }
    modes.pairs = part_of(modes.pairs, 0, k);
    return modes;
}

}   // namespace

Backend backend_of(Ranks& ranks) {
    Backend backend;
    backend.inertia_at = [&ranks](const SparseMatrix& A, const Vector& M, double sigma) { return measured_inertia(ranks, A, M, sigma); };
    backend.engine = [&ranks, count = backend.inertia_at](const SparseMatrix& A, const Vector& M, int k) {
        return distributed_modes(A, M, k, ranks, count);
    };
    backend.factor = [&ranks](const SparseMatrix& system) {
        ranks.factor(system, true);
        return RemoteFactor{[&ranks](const DenseMatrix& B) { return ranks.solve(B); }, ranks.nonzeros()};
    };
    return backend;
}

}   // namespace meshfolio
