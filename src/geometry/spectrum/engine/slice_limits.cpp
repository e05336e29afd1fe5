#include "geometry/spectrum/engine/slice_limits.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/available_memory.h"
#include "base/errors.h"
#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {

namespace {

/// σ where the counts, taken as a polygon, reach `count`.
double sigma_at(const std::vector<Inertia>& counts, double count) {
    for (std::size_t i = 1; i < counts.size(); ++i) {
        if (counts[i].below < count && i + 1 < counts.size()) continue;
        const double share = (count - counts[i - 1].below) / std::max(1, counts[i].below - counts[i - 1].below);
        return counts[i - 1].sigma + share * (counts[i].sigma - counts[i - 1].sigma);
    }
    return counts.back().sigma;
}

void insert(std::vector<Inertia>& counts, const Inertia& proof) {
    const auto place = std::upper_bound(counts.begin(), counts.end(), proof.sigma, [](double s, const Inertia& p) { return s < p.sigma; });
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

/// Vectors in the basis of a slice of that many pairs: measured 3 to 4 a pair, and some at its ends.
double basis_for(double pairs) { return 80 + 4 * pairs; }

std::string gigabytes(double bytes) { return plain_text(bytes / 1e9, 3) + " GB"; }

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

std::vector<Inertia> bracket_from_above(const SpectrumProblem& problem, int wanted) {
    constexpr int most_counts = 24;
    const int enough = wanted + std::max(6, wanted / 24);
    const double top = above_all(problem.B);
    const double weyl = std::min(4 * pi * (wanted + 10), 0.9 * top);   // N(μ) ≈ μ / 4π at area 1
    Inertia low, high;
    run_tasks([&] { low = count_near(problem, 0.96 * weyl); }, [&] { high = count_near(problem, 1.04 * weyl); });
    std::vector<Inertia> counts = {{0, problem.zeros.count(), 0}};
    insert(counts, low);
    insert(counts, high);
    for (int i = 0; i < most_counts; ++i) {
        const auto above = std::find_if(counts.begin(), counts.end(), [&](const Inertia& p) { return p.below >= wanted; });
        const bool found = above != counts.end();
        if (found) counts.erase(above + 1, counts.end());
        if (found && (above->below <= enough || above->sigma - (above - 1)->sigma <= 4 * clear_gap * above->sigma)) break;
        if (!found) {
            const int middle = wanted + (enough - wanted) / 2;
            const double next = sigma_at(counts, middle) * (counts.back().below > 0 ? 1.0 : 2.0);
            insert(counts, count_near(problem, std::clamp(next, 1.02 * counts.back().sigma, std::max(top, 1.02 * counts.back().sigma))));
            continue;
        }
        // Between by the polygon, or by halving where that creeps.
        const double a = (above - 1)->sigma, b = above->sigma;
        const double guess = i < 4 ? sigma_at(counts, 0.5 * (wanted + enough)) : 0.5 * (a + b);
        insert(counts, count_near(problem, std::clamp(guess, a + 0.02 * (b - a), b - 0.02 * (b - a))));
    }
    if (counts.back().below < wanted) throw SolverError("inertia counts fewer eigenvalues than the operator has rows");
    return counts;
}

std::vector<SliceGoal> slice_goals(const SpectrumProblem& problem, const std::vector<Inertia>& counts, const SliceOptions& options) {
    const int zeros = problem.zeros.count(), pairs = counts.back().below - zeros;
    int slices = std::max(2, (pairs + options.pairs_per_slice - 1) / options.pairs_per_slice);
    slices += slices % 2;   // for two processors
    std::vector<double> limit{0};
    const double first = 0.5;   // of a slice: the first shift lies at its lower end
    for (int i = 1; i < slices; ++i)
        limit.push_back(std::max(limit.back(), sigma_at(counts, zeros + pairs * (i - first) / (slices - first))));
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
    if (counts.back().below == problem.size()) goals.back().to_the_end = true;
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

SpectrumMemory memory_of(const SpectrumProblem& problem, int k, const SliceOptions& options) {
    constexpr double bytes_per_entry = 8 + 6;   // of a factor: numbers and rows, and the fronts that wait for their parents
    const double n = problem.size(), pairs = k > options.one_slice_up_to ? options.pairs_per_slice : k;
    return {bytes_per_entry * static_cast<double>(problem.analysis.entries()) + 8 * n * basis_for(pairs), 2 * 8 * n * k};
}

int slices_that_fit(const SpectrumProblem& problem, int k, const SliceOptions& options, double limit) {
    const int processors = options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
    if (limit <= 0) limit = available_memory().bytes;
    if (limit <= 0) return processors;
    const SpectrumMemory needed = memory_of(problem, k, options);
    const double slices = (limit - needed.vectors) / needed.per_slice;
    if (slices >= 1) return static_cast<int>(std::min<double>(processors, slices));
    int fitting = 0, too_many = k;   // memory grows with the pairs
    while (too_many - fitting > 1) {
        const int middle = (fitting + too_many) / 2;
        (memory_of(problem, middle, options).of_one_slice() <= limit ? fitting : too_many) = middle;
    }
    throw SolverError(std::to_string(k) + " eigenpairs of " + std::to_string(problem.size()) + " vertices need " +
                          gigabytes(needed.of_one_slice()) + " of memory, " + gigabytes(limit) + " are there",
                      fitting >= 1 ? std::to_string(fitting) + (fitting == 1 ? " eigenpair" : " eigenpairs") + " would fit"
                                   : "not even one eigenpair would fit: simplify the mesh");
}

}   // namespace meshfolio
