/// @file
/// The k smallest eigenpairs of −Cφ = μMφ slice by slice (Ericsson & Ruhe 1980; Grimes, Lewis & Simon 1994; on surfaces Vallet &
/// Lévy 2008): each slice is one shift, one factor of Eigen and one run of Spectra. Counts of inertia give the number of pairs in each
/// slice. A further run, orthogonal to the known pairs, finds those that one run misses, such as members of a multiple eigenvalue. Private
/// to the layer.
#pragma once

#include "base/errors.h"
#include "geometry/spectrum/engine/slice_limits.h"
#include "geometry/spectrum/engine/spectrum_modes.h"

namespace meshfolio {

/// Eigenvalues too close to each other for Spectra to find all that are counted.
class CrowdedSpectrum : public SolverError {
public:
    using SolverError::SolverError;
};

/// Finds the k smallest pairs besides the constant, rows of Y in the order of problem.symmetric.
/// @throws SolverError if −C is not positive semidefinite; CrowdedSpectrum if inertia counts pairs that are not found
Modes find_by_slices(const SpectrumProblem& problem, int k, const SpectrumOptions& options);

/// Returns how many slices for k pairs fit into the memory limit at a time, at most options.threads.
/// @throws SolverError if not even one does, with the number of pairs that would fit
int slices_that_fit(const SpectrumProblem& problem, int k, const SpectrumOptions& options);
/// Returns the memory for k pairs with one slice at a time. [bytes]
double memory_of_one_slice(const SpectrumProblem& problem, int k, const SpectrumOptions& options);

}   // namespace meshfolio
