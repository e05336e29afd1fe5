#include "geometry/smoothing/conjugate_gradients.h"

#include <limits>
#include <string>

#include "base/errors.h"
#include "base/parallel.h"

namespace meshfolio {

namespace {

/// Σ over rows of value(i), coordinate by coordinate, block by block in order.
template <class Value>
Four row_sum(int n, Value value) {
    const auto blocks = of_blocks(n, [&](int begin, int end) {
        Four sum = Four::Zero();
        for (int i = begin; i < end; ++i) sum += value(i);
        return sum;
    });
    Four sum = Four::Zero();
    for (const auto& block : blocks) sum += block.value;
    return sum;
}

/// a/b; 0 where b is, which is where a coordinate is solved already, to the last bit.
Four quotient(const Four& a, const Four& b) {
    Four result;
    for (int c = 0; c < 4; ++c) result[c] = b[c] != 0 ? a[c] / b[c] : 0;
    return result;
}

}   // namespace

ConjugateGradients::ConjugateGradients(const OperatorWithMass& whole, const SparseMatrix& system, double lambda)
    : M_(whole.M), lambda_(lambda), L_(difference_rows(whole)), preconditioner_(incomplete_cholesky(system)) {}

void ConjugateGradients::apply(const FourColumns& p, FourColumns& q) const {
    for_blocks(L_.rows(), [&](int, int begin, int end) {
        explicit_rows(L_, -lambda_, p, begin, end, std::numeric_limits<double>::max(), q);
        for (int i = begin; i < end; ++i) row_of(q, i) *= M_[i];
    });
}

int ConjugateGradients::solve(FourColumns& X) const {
    constexpr int most_iterations = 5000;
    const int n = L_.rows();
    FourColumns r(n), z(n), p(n), q(n);
    apply(X, q);
    for_each_index(n, [&](int i) { row_of(r, i) = M_[i] * row_of(X, i) - row_of(q, i); });
    const Four goal = tolerance * tolerance * row_sum(n, [&](int i) { return Four(M_[i] * row_of(X, i).square()); });
    const auto rest = [&] { return row_sum(n, [&](int i) { return Four(row_of(r, i).square() / M_[i]); }); };
    if ((rest() <= goal).all()) return 0;

    meshfolio::solve(preconditioner_, r, z);
    for_each_index(n, [&](int i) { row_of(p, i) = row_of(z, i); });
    Four rz = row_sum(n, [&](int i) { return Four(row_of(r, i) * row_of(z, i)); });
    for (int iteration = 1; iteration <= most_iterations; ++iteration) {
        apply(p, q);
        const Four alpha = quotient(rz, row_sum(n, [&](int i) { return Four(row_of(p, i) * row_of(q, i)); }));
        for_each_index(n, [&](int i) {
            row_of(X, i) += alpha * row_of(p, i);
            row_of(r, i) -= alpha * row_of(q, i);
        });
        if ((rest() <= goal).all()) return iteration;
        meshfolio::solve(preconditioner_, r, z);
        const Four next = row_sum(n, [&](int i) { return Four(row_of(r, i) * row_of(z, i)); });
        const Four beta = quotient(next, rz);
        rz = next;
        for_each_index(n, [&](int i) { row_of(p, i) = row_of(z, i) + beta * row_of(p, i); });
    }
    throw SolverError("implicit step: conjugate gradients did not end within " + std::to_string(most_iterations) + " iterations",
                      "take a smaller lambda");
}

}   // namespace meshfolio
