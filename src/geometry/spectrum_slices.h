/// @file
/// The k smallest eigenpairs of −Cφ = μMφ slice by slice (Ericsson & Ruhe 1980; Grimes, Lewis & Simon 1994; on surfaces Vallet &
/// Lévy 2008), with the inertia of every shift to prove that none was missed. Private to the layer.
#pragma once

#include "geometry/spectrum_slice.h"

namespace meshfolio {

struct SliceOptions {
    double tolerance = 1e-9;
    bool polish = false;
    int pairs_per_slice = 80;
    int one_slice_up_to = 60;                    // nonzero pairs; more are sliced
    int threads = 0;                             // slices at a time at most; 0: as many as there are processors
    std::function<void(double)> progress = {};   // fraction done; may throw to stop
};

struct InertiaProof {
    double sigma = 0;
    int counted = 0;   // eigenvalues below σ, zero modes included
    int found = 0;
};

struct SlicedPairs {
    Vector mu;                          // without the zero modes, ascending
    DenseMatrix Y;                      // orthonormal, in the order of the matrix
    std::vector<InertiaProof> proofs;   // ascending; the last above all pairs
    SpectrumTimes times;
    int slices = 0, repairs = 0;
};

/// @param k  pairs besides the zero modes
/// @throws SolverError if −C is not positive semidefinite or inertia counts pairs that are not found
SlicedPairs find_by_slices(const SpectrumProblem& problem, int k, const SliceOptions& options);

}   // namespace meshfolio
