#include "geometry/linear/inertia.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {

Inertia inertia_at(const SparseMatrix& A, const Vector& M, double sigma) {
    const SparseFactor factor = SparseFactor::ldlt(A + SparseMatrix((-sigma * M).asDiagonal()));
    // Forming a − σm rounds by u|a − σm|, which the bound of the factor includes, and by u|σ|m.
    return {sigma, factor.negative_pivots(), factor.backward_error(M) + epsilon * std::abs(sigma)};
}

std::optional<Inertia> inertia_between(const SparseMatrix& A, const Vector& M, double low, double high, const InertiaAt& count) {
    constexpr int most_factored = 4;
    std::optional<Inertia> best;
    double best_margin = 0;   // distance from the nearer end, in units of δ
    int factored = 0;
    for (const double share : {0.5, 0.382, 0.618, 0.271, 0.733, 0.189, 0.817}) {
        const double sigma = low + share * (high - low);
        try {
            const Inertia inertia = count(A, M, sigma);
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
