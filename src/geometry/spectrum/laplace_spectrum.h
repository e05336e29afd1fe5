/// @file
/// The smallest eigenpairs of −Cφ = μMφ, ascending, M-orthonormal.
#pragma once

#include <functional>

#include "geometry/linear/inertia.h"
#include "geometry/operators/cotangent_laplacian.h"

namespace meshfolio {

struct Modes;
/// Another way to the k smallest pairs of a connected operator −C with masses that sum to 1: that of several processes
/// (geometry/distributed). Called by one thread.
using SpectrumEngine = std::function<Modes(const SparseMatrix& A, const Vector& M, int k)>;

struct SpectrumOptions {
    /// Relative residual asked of each pair. Where needles raise the largest row, rounding leaves some ε max(A_ii/M_ii) / μ at the least.
    double tolerance = 1e-9;
    bool polish = false;          // residuals down to 1e-11 where rounding lets them: more solves
    int dense_below = 700;        // vertices in use at or below which all pairs are found at once by a dense solver
    int one_slice_up_to = 60;     // pairs besides the zero modes; more are found slice by slice
    int pairs_per_slice = 40;     // shorter bases pay for more factors
    int threads = 0;              // slices at a time at most; 0: one a processor. The result is the same
    double memory_limit = 0;      // bytes that may be taken; 0: as much as the machine has left
    SpectrumEngine engine = {};   // instead of the built-in one; limits do not apply then
    InertiaAt inertia_at = meshfolio::inertia_at;
    std::function<void(double)> progress = {};   // fraction done, in [0, 1]; called from any thread, one at a time; may throw to stop
};

struct Spectrum {
    Vector eigenvalues;         // k values μ ≥ 0, ascending; the zero modes are exactly 0 [1/length²]
    DenseMatrix eigenvectors;   // n × k, ΦᵀMΦ = I; the largest entry of a column is positive; 0 at unreferenced vertices [1/length]
    Vector residuals;           // ‖−Cφ − μMφ‖ / (μ‖Mφ‖); for the zero modes ‖Cφ‖ of the component scaled to area 1
    bool dense = false;         // which solver ran for the whole; small components always go the dense way
    /// Negative pivots of −C − σM for one σ above μ_k (or between μ_k and the next known eigenvalue), and how many eigenvalues found
    /// lie below that σ: equal when none was missed. −1, −1 when not computed, or when rounding may have changed the count.
    int inertia_count = -1, found_below = -1;
    double inertia_shift = 0;   // that σ [1/length²]
    /// In the middle of the first clear gap known behind μ_k, where a count proves most; 0: none is known. A hint, not a claim. [1/length²]
    double gap_middle = 0;

    int slices = 0, repairs = 0;   // of the spectrum; how often something missed was looked for again
};

/// k is cut to the number of vertices with mass. Dense for small meshes. Otherwise shift-invert Lanczos: one slice with σ slightly below 0
/// for few pairs, several side by side for many, their limits found by inertia counts, against which what was found is held.
/// Components are solved each alone, and every vector lives on one of them. Memory is estimated first.
/// @throws MeshError if k < 1; SolverError if the memory would not suffice or pairs are not found that a count of inertia, beyond its
/// rounding, says are there
Spectrum smallest_eigenpairs(const LaplaceBeltrami& laplacian, int k, const SpectrumOptions& options = {});

/// ‖ΦᵀMΦ − I‖, largest entry.
double orthonormality_error(const Spectrum& spectrum, const Vector& M);

}   // namespace meshfolio
