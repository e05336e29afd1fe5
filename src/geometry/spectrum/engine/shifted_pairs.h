/// @file
/// Eigenpairs of B near one shift, by Spectra's shift-invert Lanczos on a factor of Eigen. Private to the layer.
#pragma once

#include <algorithm>
#include <functional>

#include "geometry/linear/sparse_factor.h"

namespace meshfolio {

/// Pairs By = μy with y = M^½ φ, eigenvalues ascending, columns orthonormal.
struct SymmetricPairs {
    Vector mu;
    DenseMatrix Y;

    int count() const { return static_cast<int>(mu.size()); }
    int count_below(double sigma) const { return static_cast<int>((mu.array() < sigma).count()); }
};

/// Returns all pairs of `a` and `b`, ascending; of equal values the pairs of `a` first.
SymmetricPairs merged(const SymmetricPairs& a, const SymmetricPairs& b);
/// Returns the pairs number first … last − 1, counted from 0.
SymmetricPairs part_of(const SymmetricPairs& pairs, int first, int last);

/// By = μy of a connected surface of area 1. Its constant is known and left out of all searches.
struct SpectrumProblem {
    /// @param A  −C, @param M  its masses, Σ M = 1
    SpectrumProblem(const SparseMatrix& A, const Vector& M);

    SparseMatrix symmetric;   // M^−½ A M^−½, every diagonal entry stored
    EliminationOrder order;
    SparseMatrix B;       // in the order of elimination
    Vector zero;          // the constant: M^½ in that order, a unit vector, B zero = 0
    double highest = 0;   // above every eigenvalue (Gershgorin)

    int size() const { return static_cast<int>(B.rows()); }
    int others() const { return size() - 1; }   // besides the constant
};

/// A factor of B − σI.
struct Shift {
    double sigma;
    OrderedFactor factor;

    /// Returns the number of eigenvalues below σ > 0, without the eigenvalue 0 of the constant.
    int others_below() const { return std::max(0, factor.negative_pivots() - 1); }
    /// Returns the rounding δ of others_below() (inertia.h).
    double delta() const;
};

/// Returns a factor at `sigma`, or at most `reach` beside it: the first of five whose pivots grow by at most 1e4, else the one with the
/// least growth. LDLᵀ is not pivoted: if σ makes a leading part nearly singular, pivots and rounding grow, or a pivot is lost. @throws
/// SolverError if a pivot is lost at all five
Shift shift_near(const SpectrumProblem& problem, double sigma, double reach);
/// Factors at `sigma` < 0 or, if needles make rounding larger, farther below. @throws SolverError if −C is not positive semidefinite
Shift shift_below_zero(const SpectrumProblem& problem, double sigma);

struct PairSearch {
    int wanted = 1;
    double tolerance = 1e-9;                   // wanted relative residual of each pair
    std::function<void(double)> report = {};   // takes the share of the expected work done; may throw to stop
};

/// Finds the pairs nearest to σ, orthogonal to the constant and to `known`: as many as wanted, or as many as Spectra finds.
SymmetricPairs pairs_near(const SpectrumProblem& problem, const Shift& shift, const DenseMatrix& known, const PairSearch& search);

/// Finds the pairs nearest to σ, orthogonal to the constant and to `known`, by subspace iteration with a block of all wanted pairs and up
/// to eight more, for clusters that no Krylov space separates. Returns the pairs with small residuals.
SymmetricPairs pairs_by_iteration(const SpectrumProblem& problem, const Shift& shift, const DenseMatrix& known, const PairSearch& search);

/// Returns ‖By − μy‖ / |μ| of each pair, μ ≠ 0, y of length 1.
Vector residuals_of(const SparseMatrix& B, const SymmetricPairs& pairs);

}   // namespace meshfolio
