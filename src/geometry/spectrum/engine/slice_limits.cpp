#include "geometry/spectrum/engine/slice_limits.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {

namespace {

InertiaProof counted(const SpectrumProblem& problem, double sigma) {
    const Inertia inertia = count_near(problem, sigma);
    return {inertia.sigma, inertia.below, 0, inertia.delta, true};
}

/// σ where the counts, taken as a polygon, reach `count`.
double sigma_at(const std::vector<InertiaProof>& counts, double count) {
    for (std::size_t i = 1; i < counts.size(); ++i) {
        if (counts[i].counted < count && i + 1 < counts.size()) continue;
        const double share = (count - counts[i - 1].counted) / std::max(1, counts[i].counted - counts[i - 1].counted);
        return counts[i - 1].sigma + share * (counts[i].sigma - counts[i - 1].sigma);
    }
    return counts.back().sigma;
}

void insert(std::vector<InertiaProof>& counts, const InertiaProof& proof) {
    const auto place =
        std::upper_bound(counts.begin(), counts.end(), proof.sigma, [](double s, const InertiaProof& p) { return s < p.sigma; });
    counts.insert(place, proof);
}

/// −10⁻⁶ of an ordinary eigenvalue: small against those sought, large enough for pivots that are surely positive. The median of the
/// diagonal, because needles raise its mean.
double sigma_below_zero(const SparseMatrix& B) {
    Vector diagonal = B.diagonal();
    double* const middle = diagonal.data() + diagonal.size() / 2;
    std::nth_element(diagonal.data(), middle, diagonal.data() + diagonal.size());
    return *middle > 0 ? -1e-6 * *middle : -1e-6;
}

/// Half of a large space is enough for the pairs of one slice; a small one may be needed whole.
int largest_basis(const SpectrumProblem& problem, int usual) {
    constexpr int always = 128;
    const int whole = problem.size() - problem.zeros.count();
    return std::min({usual, whole, std::max(always, problem.size() / 2)});
}

}   // namespace

double above_all(const SparseMatrix& B) {
    double bound = 0;
    for (int j = 0; j < B.cols(); ++j) {
        double sum = 0;
        for (SparseMatrix::InnerIterator entry(B, j); entry; ++entry) sum += std::abs(entry.value());
        bound = std::max(bound, sum);
    }
    return bound > 0 ? 1.001 * bound : 1;
}

std::vector<InertiaProof> bracket_from_above(const SpectrumProblem& problem, int wanted) {
    constexpr int most_counts = 24;
    const int enough = wanted + std::max(6, wanted / 24);
    const double top = above_all(problem.B);
    const double weyl = std::min(4 * pi * (wanted + 10), 0.9 * top);   // N(μ) ≈ μ / 4π at area 1
    InertiaProof low, high;
    run_tasks([&] { low = counted(problem, 0.96 * weyl); }, [&] { high = counted(problem, 1.04 * weyl); });
    std::vector<InertiaProof> counts = {{0, problem.zeros.count()}};
    insert(counts, low);
    insert(counts, high);
    for (int i = 0; i < most_counts; ++i) {
        const auto above = std::find_if(counts.begin(), counts.end(), [&](const InertiaProof& p) { return p.counted >= wanted; });
        const bool found = above != counts.end();
        if (found) counts.erase(above + 1, counts.end());
        if (found && (above->counted <= enough || above->sigma - (above - 1)->sigma <= 4 * clear_gap * above->sigma)) break;
        if (!found) {
            const int middle = wanted + (enough - wanted) / 2;
            const double next = sigma_at(counts, middle) * (counts.back().counted > 0 ? 1.0 : 2.0);
            insert(counts, counted(problem, std::clamp(next, 1.02 * counts.back().sigma, std::max(top, 1.02 * counts.back().sigma))));
            continue;
        }
        // Between by the polygon, or by halving where that creeps.
        const double a = (above - 1)->sigma, b = above->sigma;
        const double guess = i < 4 ? sigma_at(counts, 0.5 * (wanted + enough)) : 0.5 * (a + b);
        insert(counts, counted(problem, std::clamp(guess, a + 0.02 * (b - a), b - 0.02 * (b - a))));
    }
    if (counts.back().counted < wanted) throw SolverError("inertia counts fewer eigenvalues than the operator has rows");
    return counts;
}

std::vector<SliceGoal> slice_goals(const SpectrumProblem& problem, const std::vector<InertiaProof>& counts, const SliceOptions& options) {
    const int zeros = problem.zeros.count(), pairs = counts.back().counted - zeros;
    int slices = std::max(2, (pairs + options.pairs_per_slice - 1) / options.pairs_per_slice);
    slices += slices % 2;   // for two processors
    std::vector<double> limit{0};
    const double first = 0.5;   // of a slice: the first shift lies at its lower end
    for (int i = 1; i < slices; ++i) {
        limit.push_back(std::max(limit.back(), sigma_at(counts, zeros + pairs * (i - first) / (slices - first))));
    }
    limit.push_back(counts.back().sigma);
    std::vector<SliceGoal> goals;
    for (std::size_t i = 0; i + 1 < limit.size(); ++i) {
        SliceGoal goal;
        goal.low = limit[i];
        goal.high = limit[i + 1];
        goal.expected = pairs / (slices - first) * (i > 0 ? 1 : 1 - first);
        if (!(goal.high > goal.low)) continue;   // many eigenvalues at one place
        // Distances from σ are what is accurate, so the smallest eigenvalues need a σ near zero.
        goal.sigma = goal.low > 0 ? 0.5 * (goal.low + goal.high) : sigma_below_zero(problem.B);
        goal.largest_basis = largest_basis(problem, 200 + 8 * options.pairs_per_slice);
        goal.tolerance = options.tolerance;
        goal.polish = options.polish;
        goal.seed = i;
        goals.push_back(goal);
    }
    if (counts.back().counted == problem.size()) goals.back().to_the_end = true;
    return goals;
}

SliceGoal one_goal(const SpectrumProblem& problem, int k, const SliceOptions& options) {
    SliceGoal goal;
    goal.sigma = sigma_below_zero(problem.B);
    goal.at_least = k;
    goal.expected = k;
    goal.tolerance = options.tolerance;
    goal.polish = options.polish;
    goal.largest_basis = largest_basis(problem, 200 + 12 * k);
    goal.parallel = true;
    return goal;
}

}   // namespace meshfolio
