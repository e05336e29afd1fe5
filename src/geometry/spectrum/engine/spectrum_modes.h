/// @file
/// The smallest eigenpairs of one operator in symmetric form, dense or by slices. Private to the layer.
#pragma once

#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/engine/shifted_pairs.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// The k smallest pairs in symmetric form, zero modes first.
struct Modes {
    SymmetricPairs pairs;
    double gap_middle = 0;   // of the first clear gap above the pairs; 0: not known
    bool dense = false;
    int slices = 0, repairs = 0;   // repairs: repeated searches for missed pairs
};

/// An interval without eigenvalues.
struct Gap {
    double low, high;
    double middle() const { return 0.5 * (low + high); }
};
/// Returns the first clear gap of the ascending `mu` above its k-th entry, or an interval above its last. A cluster is never cut: rounding
/// would decide on which side of σ its members are.
Gap gap_behind(const Vector& mu, int k);

/// Returns the residual of each pair in the norm of the equations −Cφ = μMφ: ‖M^½(By − μy)‖ / (μ‖M^½y‖); for μ = 0 ‖M^½By‖.
Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs);

/// Computes all pairs of M^-½AM^-½ by a dense solver, ascending; the first is set to μ = 0 with y = M^½·1, normalised.
/// @throws SolverError if an eigenvalue is negative beyond rounding
SymmetricPairs dense_pairs(const SparseMatrix& A, const Vector& M);

/// Computes the k smallest pairs of a connected operator, dense or by slices.
/// @param A  −C, @param M  its masses, ΣM = 1
/// @throws SolverError if pairs are counted and not found
Modes modes_of(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options);

/// Computes the k smallest pairs of an operator of several components, each solved separately, scaled to area 1, and merged: so no solver
/// meets multiplicities of equal components, or differences of scale.
/// @param A, M        as in modes_of()
/// @param components  of A
/// @param k           at most the rows of A
/// @throws SolverError as modes_of(), or if the k vectors alone exceed the memory
Modes modes_of_components(const SparseMatrix& A, const Vector& M, const Components& components, int k, const SpectrumOptions& options);

}   // namespace meshfolio
