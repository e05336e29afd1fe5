#include "geometry/smoothing/diffusion_step.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "base/at.h"
#include "base/parallel.h"

namespace meshfolio {

FourColumns gathered(const Positions& X, const std::vector<int>& vertex) {
    FourColumns rows(std::ssize(vertex), 4);
    for_each_index(static_cast<int>(vertex.size()), [&](int i) { rows.row(i) << X.row(vertex[at(i)]), 0; });
    return rows;
}

void scatter(const FourColumns& rows, const std::vector<int>& vertex, Positions& X) {
    for_each_index(static_cast<int>(vertex.size()), [&](int i) { X.row(vertex[at(i)]) = rows.row(i).head<3>(); });
}

bool explicit_rows(const DifferenceRows& L, double lambda, const FourColumns& X, int first, int last, double bound, FourColumns& Y) {
    const int *const start = L.outerIndexPtr(), *const column = L.innerIndexPtr();
    const double* const weight = L.valuePtr();
    bool near = true;
    for (int i = first; i < last; ++i) {
        const Four x = row_of(X, i);
        Four sum = Four::Zero();
        for (int k = start[i], end = start[i + 1]; k < end; ++k) sum += weight[k] * (row_of(X, column[k]) - x);
        const Four y = x + lambda * sum;
        row_of(Y, i) = y;
        near = near && (y.abs() <= bound).all();
    }
    return near;
}

ExplicitDiffusion::ExplicitDiffusion(const OperatorWithMass& whole) : vertex_(whole.vertex), copies_(whole.copies), L_(whole.A) {
    for (int i = 0; i < whole.size(); ++i)
        for (DifferenceRows::InnerIterator entry(L_, i); entry; ++entry) entry.valueRef() /= -whole.M[i];
    L_.prune([](Eigen::Index i, Eigen::Index j, double) { return i != j; });
}

bool ExplicitDiffusion::step(double lambda, const FourColumns& X, FourColumns& Y, double bound) const {
    constexpr int rows_a_task = 4096;
    std::atomic<bool> near = true;
    const auto body = [&](const tbb::blocked_range<int>& rows) {
        if (!explicit_rows(L_, lambda, X, rows.begin(), rows.end(), bound, Y)) near = false;
    };
    // Each thread returns to the rows in its cache.
    tbb::parallel_for(tbb::blocked_range<int>(0, static_cast<int>(L_.rows()), rows_a_task), body, tbb::static_partitioner());
    return near;
}

Positions ExplicitDiffusion::step(double lambda, const Positions& X) const {
    FourColumns next(L_.rows(), 4);
    step(lambda, gathered(X, vertex_), next);
    Positions result = X;
    scatter(next, vertex_, result);
    spread(copies_, result);
    return result;
}

}   // namespace meshfolio
