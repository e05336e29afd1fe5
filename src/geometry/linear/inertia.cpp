#include "geometry/linear/inertia.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "geometry/distributed/ranks.h"
#include "geometry/linear/ldlt_analysis.h"
#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/random_numbers.h"

namespace meshfolio {

namespace {

/// δ of the factor of S that the ranks hold. With ET, T = (S + E)⁻¹S, in place of E, and ‖E‖ ≤ 2‖ET‖ unless an eigenvalue lies within δ.
/// That one of ten random vectors shows a tenth of a norm, at least: Halko, Martinsson & Tropp 2011, lemma 4.1.
double measured_backward_error(Ranks& ranks, const SparseMatrix& S, const Vector& M) {
    constexpr int probes = 10;
    constexpr double roundings = 10 * std::numeric_limits<double>::epsilon() / 2;   // of a row's product, seven entries long or so
    const SparseMatrix sizes = S.cwiseAbs();
    const Vector root = M.cwiseSqrt();
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
    return 20 * largest;
}

}   // namespace

Inertia inertia_at(const SparseMatrix& A, const Vector& M, double sigma, Ranks* ranks) {
    SparseMatrix diagonal(A.rows(), A.cols());
    diagonal = (-sigma * M).asDiagonal();
    // Forming a − σm rounds to u|a − σm|, which the factor's bound has room for, and to u|σ|m.
    const double forming = std::numeric_limits<double>::epsilon() * std::abs(sigma);
    const SparseMatrix S = A + diagonal;
    if (ranks != nullptr) {
        ranks->factor(S, false);
        const double largest_row = std::numeric_limits<double>::epsilon() * S.diagonal().cwiseAbs().cwiseQuotient(M).maxCoeff();
        return {sigma, ranks->negative_pivots(), measured_backward_error(*ranks, S, M) + forming + largest_row};
    }
    const SparseMatrix whole = S.selfadjointView<Eigen::Lower>();
    const LdltPanels factor = LdltAnalysis(whole).factor(whole, 0, true);
    return {sigma, factor.negative_pivots(), backward_error(factor, M) + forming};
}

std::optional<Inertia> inertia_between(const SparseMatrix& A, const Vector& M, double low, double high, Ranks* ranks) {
    constexpr int most_factored = 4;
    std::optional<Inertia> best;
    double best_margin = 0;   // distance from the nearer end, in units of δ
    int factored = 0;
    for (const double share : {0.5, 0.382, 0.618, 0.271, 0.733, 0.189, 0.817}) {
        const double sigma = low + share * (high - low);
        try {
            const Inertia inertia = inertia_at(A, M, sigma, ranks);
            const double margin = std::min(sigma - low, high - sigma) / inertia.delta;
            if (!best || margin > best_margin) {
                best = inertia;
                best_margin = margin;
            }
            if (margin > 1 || ++factored == most_factored) break;
        } catch (const SolverError&) {   // a pivot was lost in rounding
        }
    }
    return best;
}

}   // namespace meshfolio
