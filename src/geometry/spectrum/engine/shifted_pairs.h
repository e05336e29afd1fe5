/// @file
/// Eigenpairs of B around one shift, by Spectra's shift-invert Lanczos on a factor of Eigen. Private to the layer.
#pragma once

#include <algorithm>
#include <functional>

#include "geometry/linear/sparse_factor.h"

namespace meshfolio {

/// y = M^½ φ: orthonormal columns, eigenvalues ascending.
struct SymmetricPairs {
    Vector mu;
    DenseMatrix Y;

    int count() const { return static_cast<int>(mu.size()); }
    int count_below(double sigma) const { return static_cast<int>((mu.array() < sigma).count()); }
};

/// Both together, ascending; of equal values those of `a` first.
SymmetricPairs merged(const SymmetricPairs& a, const SymmetricPairs& b);
/// The pairs from place `first` up to `last`, without it.
SymmetricPairs part_of(const SymmetricPairs& pairs, int first, int last);

/// Bφ = μφ of a connected surface of area 1. Its constant is known: all below leaves it aside.
struct SpectrumProblem {
    /// @param A  −C, @param M  its masses, Σ M = 1
    SpectrumProblem(const SparseMatrix& A, const Vector& M);

    SparseMatrix symmetric;   // M^−½ A M^−½, every diagonal entry stored
    EliminationOrder order;
    SparseMatrix B;       // in the order of elimination
    Vector zero;          // M^½ in that order, a unit vector: B zero = 0
    double highest = 0;   // above every eigenvalue (Gershgorin)

    int size() const { return static_cast<int>(B.rows()); }
    int others() const { return size() - 1; }   // besides the constant
};

/// A factor of B − σI.
struct Shift {
    double sigma;
    OrderedFactor factor;

    /// Eigenvalues below σ > 0, besides the constant's.
    int others_below() const { return std::max(0, factor.negative_pivots() - 1); }
    /// Rounding of the count of its negative pivots (inertia.h).
    double delta() const;
};

/// Near `sigma`, moved by `reach` at most: LDLᵀ is not pivoted, and where σ makes some leading part nearly singular, pivots and rounding
/// grow, or a pivot is lost. @throws SolverError if it is everywhere
Shift shift_near(const SpectrumProblem& problem, double sigma, double reach);
/// At `sigma` < 0 or, where needles make rounding larger, farther below. @throws SolverError if −C is not positive semidefinite
Shift shift_below_zero(const SpectrumProblem& problem, double sigma);

struct PairSearch {
    int wanted = 1;
    double tolerance = 1e-9;                   // relative residual asked of each pair
    std::function<void(double)> report = {};   // share of the work that is expected; may throw
};

/// Pairs nearest to σ that are orthogonal to the constant and to `known`: as many as wanted, or fewer where Spectra does not find more.
SymmetricPairs pairs_near(const SpectrumProblem& problem, const Shift& shift, const DenseMatrix& known, const PairSearch& search);

/// The same by subspace iteration with a block of all that are wanted: for clusters that no Krylov space tells apart.
SymmetricPairs pairs_by_iteration(const SpectrumProblem& problem, const Shift& shift, const DenseMatrix& known, const PairSearch& search);

/// ‖By − μy‖ / μ of each pair.
Vector residuals_of(const SparseMatrix& B, const SymmetricPairs& pairs);

}   // namespace meshfolio
