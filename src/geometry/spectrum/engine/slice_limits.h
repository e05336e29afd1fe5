/// @file
/// Where to slice a spectrum, by counts of inertia that begin with Weyl's law. Private to the layer.
#pragma once

#include <vector>

#include "geometry/spectrum/engine/shifted_pairs.h"

namespace meshfolio {

/// Relative distance of two eigenvalues from which they are not one cluster: rounding may turn the members of a cluster about.
constexpr double clear_gap = 1e-5;
/// And from which counts still tell them apart.
constexpr double least_gap = 1e-9;

/// How many eigenvalues besides 0 lie below σ; rounding may have moved σ by δ.
struct Count {
    double sigma = 0;
    int others = 0;
    double delta = 0;
};
/// At σ or, where a pivot is lost in rounding, no farther beside it than `reach`. @throws SolverError as `shift_near`
Count count_near(const SpectrumProblem& problem, double sigma, double reach);

/// Counts at growing σ: 0 first, then limits of slices of some `pairs_per_slice` each; the last has at least `wanted` below, and few more
/// where the spectrum has a gap there. A cluster too large for a slice has limits as close to it as they can be counted.
std::vector<Count> slice_limits(const SpectrumProblem& problem, int wanted, int pairs_per_slice);

}   // namespace meshfolio
