/// @file
/// Where to slice a spectrum: found from inertia counts, beginning with Weyl's law. Private to the layer.
#pragma once

#include <vector>

#include "geometry/spectrum/engine/spectrum_slices.h"

namespace meshfolio {

/// Counts at growing σ. The last is the first found with at least `wanted` eigenvalues below, and few more where the spectrum
/// has a place for that.
std::vector<InertiaProof> bracket_from_above(const SpectrumProblem& problem, int wanted);

/// Equal numbers of eigenvalues, as far as the counts tell; a shift in the middle of each slice.
std::vector<SliceGoal> slice_goals(const SpectrumProblem& problem, const std::vector<InertiaProof>& counts, const SliceOptions& options);

/// One slice for the k smallest besides the zero modes, with σ slightly below 0.
SliceGoal one_goal(const SpectrumProblem& problem, int k, const SliceOptions& options);

/// Larger than every eigenvalue (Gershgorin).
double above_all(const SparseMatrix& B);

}   // namespace meshfolio
