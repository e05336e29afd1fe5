#include "geometry/spectrum/spectrum_memory.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <string>

#include "base/available_memory.h"
#include "base/errors.h"
#include "base/number_text.h"

namespace meshfolio {

namespace {

/// Vectors in the basis of a slice of that many pairs: measured 3 to 4 a pair, and some at its ends.
double basis_for(double pairs) { return 80 + 4 * pairs; }

std::string gigabytes(double bytes) { return plain_text(bytes / 1e9, 3) + " GB"; }

}   // namespace

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
