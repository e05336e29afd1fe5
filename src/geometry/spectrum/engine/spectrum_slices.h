/// @file
/// The k smallest eigenpairs of −Cφ = μMφ slice by slice (Ericsson & Ruhe 1980; Grimes, Lewis & Simon 1994; on surfaces Vallet &
/// Lévy 2008): each slice is one shift, one factor of Eigen and one run of Spectra. Counts of inertia tell what each slice holds, and what
/// is missed by one run, as members of a multiple eigenvalue are, is found by the next beside those known. Private to the layer.
#pragma once

#include "base/errors.h"
#include "geometry/spectrum/engine/slice_limits.h"

namespace meshfolio {

struct SliceOptions {
    double tolerance = 1e-9;
    int pairs_per_slice = 40;
    int one_slice_up_to = 60;                    // pairs besides the constant; more are sliced
    int threads = 0;                             // slices at a time at most; 0: as many as there are processors
    std::function<void(double)> progress = {};   // fraction done; may throw to stop
};

/// Eigenvalues too close to each other for Spectra to find all that are counted.
class CrowdedSpectrum : public SolverError {
public:
    using SolverError::SolverError;
};

struct SlicedPairs {
    SymmetricPairs pairs;   // besides the constant, in the order of the matrix
    Count count;            // above all of them
    int found = 0;          // below it, besides 0
    bool trusted = false;   // nothing found lies within δ of it
    int slices = 0, repairs = 0;
    double gap_middle = 0;   // of the first clear gap behind them; 0: not known
};

/// @param k  pairs besides the constant
/// @throws SolverError if −C is not positive semidefinite; CrowdedSpectrum if inertia counts pairs that are not found
SlicedPairs find_by_slices(const SpectrumProblem& problem, int k, const SliceOptions& options);

/// Slices at a time that fit into `limit` bytes; 0 for what the machine has left.
/// @param k  pairs @throws SolverError if not even one does, saying what would fit
int slices_that_fit(const SpectrumProblem& problem, int k, const SliceOptions& options, double limit);
/// What one slice at a time takes. [bytes]
double memory_of_one_slice(const SpectrumProblem& problem, int k, const SliceOptions& options);

}   // namespace meshfolio
