/// @file
/// The k smallest eigenpairs of −Cφ = μMφ slice by slice (Ericsson & Ruhe 1980; Grimes, Lewis & Simon 1994; on surfaces Vallet &
/// Lévy 2008), with the inertia of every shift to show where some were missed. Private to the layer.
#pragma once

#include "geometry/spectrum/engine/spectrum_slice.h"

namespace meshfolio {

struct SliceOptions {
    double tolerance = 1e-9;
    bool polish = false;
    int pairs_per_slice = 30;
    int one_slice_up_to = 60;                    // nonzero pairs; more are sliced
    int threads = 0;                             // slices at a time at most; 0: as many as there are processors
    std::function<void(double)> progress = {};   // fraction done; may throw to stop
};

/// Of all eigenvalues, zero modes included.
struct InertiaProof : Inertia {
    int found = 0;         // below σ
    bool trusted = true;   // no value found lies within δ of σ: else the count says nothing of what is missing
};

struct SlicedPairs {
    Vector mu;                          // without the zero modes, ascending
    DenseMatrix Y;                      // orthonormal, in the order of the matrix
    std::vector<InertiaProof> proofs;   // ascending; the last above all pairs
    SpectrumTimes times;
    int slices = 0, repairs = 0;
    double gap_middle = 0;   // of the first clear gap behind them; 0: not known
};

/// @param k  pairs besides the zero modes
/// @throws SolverError if −C is not positive semidefinite or inertia counts pairs that are not found
SlicedPairs find_by_slices(const SpectrumProblem& problem, int k, const SliceOptions& options);

}   // namespace meshfolio
