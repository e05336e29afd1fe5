/// @file
/// The smallest eigenpairs of −Cφ = μMφ, ascending, M-orthonormal.
#pragma once

#include <functional>

#include "geometry/operators/cotangent_laplacian.h"

namespace meshfolio {

struct Modes;
/// A function that computes the k smallest pairs of a connected operator −C with masses that sum to 1, by several processes
/// (geometry/distributed). Called by one thread.
using SpectrumEngine = std::function<Modes(const SparseMatrix& A, const Vector& M, int k)>;

struct SpectrumOptions {
    /// Wanted relative residual of each pair. Where needles raise the largest row, rounding leaves at least some ε max(A_ii/M_ii) / μ.
    double tolerance = 1e-9;
    bool polish = false;                         // residuals down to 1e-11 where rounding permits: more solves
    int dense_below = 700;                       // up to this number of vertices in use a dense solver finds all pairs
    int one_slice_up_to = 60;                    // pairs besides the zero modes; more are found slice by slice
    int pairs_per_slice = 40;                    // shorter bases, more factors
    int threads = 0;                             // slices at a time; 0: one a processor. The result does not depend on it
    double memory_limit = 0;                     // [bytes]; 0: the available memory
    SpectrumEngine engine = {};                  // instead of the built-in one, without its limits
    std::function<void(double)> progress = {};   // takes the share done, in [0, 1]; called by one thread at a time; may throw to stop
};

/// The k smallest eigenpairs.
struct Spectrum {
    Vector eigenvalues;         // k values μ ≥ 0, ascending; the zero modes are exactly 0 [1/length²]
    DenseMatrix eigenvectors;   // n × k, ΦᵀMΦ = I; the largest entry of a column is positive; 0 at unreferenced vertices [1/length]
    Vector residuals;           // ‖−Cφ − μMφ‖ / (μ‖Mφ‖); for the zero modes ‖Cφ‖ of the component scaled to area 1
    bool dense = false;         // true: a dense solver ran for the whole; small components always use one
    /// The middle of the first clear gap known above μ_k, where a count proves most; 0: none is known. A hint, not a claim. [1/length²]
    double gap_middle = 0;

    int slices = 0, repairs = 0;   // slices of the spectrum, repeated searches for missed pairs
};

/// Computes the k smallest eigenpairs, at most as many as vertices with mass. Dense for small meshes, else by shift-invert Lanczos: one
/// slice with σ slightly below 0 for few pairs, several in parallel for many. Counts of inertia set the limits of slices and check the
/// result. Components are solved separately, and each vector lives on one of them. Memory is estimated first.
/// @throws MeshError if k < 1; SolverError if the memory would not suffice, or if a count of inertia proves that pairs are missing
Spectrum smallest_eigenpairs(const LaplaceBeltrami& laplacian, int k, const SpectrumOptions& options = {});

/// Returns the largest entry of |ΦᵀMΦ − I|.
double orthonormality_error(const Spectrum& spectrum, const Vector& M);

}   // namespace meshfolio
