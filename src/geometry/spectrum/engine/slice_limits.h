/// @file
/// Where to slice a spectrum, from inertia counts that begin with Weyl's law, and how many slices fit into memory. Private to the layer.
#pragma once

#include <vector>

#include "geometry/spectrum/engine/spectrum_slices.h"

namespace meshfolio {

/// Counts at growing σ. The last has at least `wanted` eigenvalues below, and few more where the spectrum has a gap there.
std::vector<Inertia> bracket_from_above(const SpectrumProblem& problem, int wanted);

/// Equal numbers of eigenvalues, as far as the counts tell; a shift in the middle of each slice.
std::vector<SliceGoal> slice_goals(const SpectrumProblem& problem, const std::vector<Inertia>& counts, const SliceOptions& options);

/// One slice for the k smallest besides the zero modes, with σ slightly below 0.
SliceGoal one_goal(const SpectrumProblem& problem, int k, const SliceOptions& options);

/// Larger than every eigenvalue (Gershgorin).
double above_all(const SparseMatrix& B);

/// What the eigenpairs of a large mesh will take, before anything is begun.
struct SpectrumMemory {
    double per_slice = 0;   // a factor while it is made, and a basis, for each slice worked on at a time [bytes]
    double vectors = 0;     // of all pairs, twice while they are sorted [bytes]
    double of_one_slice() const { return per_slice + vectors; }
};

SpectrumMemory memory_of(const SpectrumProblem& problem, int k, const SliceOptions& options);

/// Slices at a time that fit into `limit`; 0 for what the machine has left.
/// @throws SolverError if not even one does, saying what would fit
int slices_that_fit(const SpectrumProblem& problem, int k, const SliceOptions& options, double limit);

}   // namespace meshfolio
