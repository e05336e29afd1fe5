/// @file
/// What the eigenpairs of a large mesh will take, before anything is begun. Private to the layer.
#pragma once

#include "geometry/spectrum/engine/spectrum_slices.h"

namespace meshfolio {

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
