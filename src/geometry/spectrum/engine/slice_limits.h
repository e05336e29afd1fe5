/// @file
/// The limits of slices of a spectrum, by counts of inertia that begin with Weyl's law. Private to the layer.
#pragma once

#include <vector>

#include "geometry/spectrum/engine/shifted_pairs.h"

namespace meshfolio {

/// The relative distance above which two eigenvalues are no cluster; rounding may mix the vectors of a cluster.
constexpr double clear_gap = 1e-5;
/// The relative distance of two eigenvalues above which counts can separate them.
constexpr double least_gap = 1e-9;

/// The number of eigenvalues besides 0 below σ; rounding may have moved σ by δ.
struct Count {
    double sigma = 0;
    int others = 0;
    double delta = 0;
};
/// Counts the eigenvalues besides 0 below σ or, if a pivot is lost in rounding, below a σ at most `reach` beside it. @throws SolverError as
/// shift_near()
Count count_near(const SpectrumProblem& problem, double sigma, double reach);

/// Returns counts at growing σ: 0 first, then limits of slices of about `pairs_per_slice` each; below the last are at least `wanted`, and
/// few more if the spectrum has a gap there. A cluster too large for a slice has limits as close to it as counts permit.
std::vector<Count> slice_limits(const SpectrumProblem& problem, int wanted, int pairs_per_slice);

}   // namespace meshfolio
