/// @file
/// The smallest eigenpairs of one operator in symmetric form, dense or by slices. Private to the layer.
#pragma once

#include <optional>

#include "geometry/linear/inertia.h"
#include "geometry/spectrum/engine/shifted_pairs.h"
#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// The eigenvalues below `sigma`, counted by inertia and among those found; −1 where rounding may have changed the count.
struct InertiaCount {
    double sigma = 0;
    int counted = -1, found = -1;
};

/// The k pairs asked for, in symmetric form, zero modes first.
struct Modes {
    SymmetricPairs pairs;
    InertiaCount inertia;
    double gap_middle = 0;   // of the first clear gap behind the pairs; 0: not known
    bool dense = false;
    int slices = 0, repairs = 0;
};

struct Gap {
    double low, high;
    double middle() const { return 0.5 * (low + high); }
};
/// The first clear gap of the ascending `mu` behind its k-th entry, or what follows its last. A cluster is never cut: rounding would
/// decide on which side of σ its members are.
Gap gap_behind(const Vector& mu, int k);

/// The inertia within a gap; nothing where its rounding is larger than the distance from either end.
std::optional<Inertia> trusted_between(const SparseMatrix& A, const Vector& M, const Gap& gap, const InertiaAt& inertia_at);

/// ‖By − μy‖ / μ for each pair, in the norm of the equations −Cφ = μMφ: ‖M^½(By − μy)‖ / (μ‖M^½y‖).
Vector relative_residuals(const SparseMatrix& B, const Vector& root_mass, const SymmetricPairs& pairs);

/// All pairs at once, the constant first.
SymmetricPairs dense_pairs(const SparseMatrix& A, const Vector& M);

/// Of a connected operator.
/// @param A  −C, @param M  its masses, ΣM = 1
/// @throws SolverError if pairs are counted and not found
Modes modes_of(const SparseMatrix& A, const Vector& M, int k, const SpectrumOptions& options);

}   // namespace meshfolio
