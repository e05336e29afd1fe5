/// @file
/// All eigenpairs of B around one shift, by block Lanczos. Private to the layer.
#pragma once

#include <functional>

#include "geometry/linear/ldlt_analysis.h"
#include "geometry/spectrum/engine/block_lanczos.h"

namespace meshfolio {

/// Bφ = μφ of a surface of area 1, analysed.
struct SpectrumProblem {
    /// @param A  −C, @param M  its masses, Σ M = 1
    SpectrumProblem(const SparseMatrix& A, const Vector& M);

    SparseMatrix B;   // M^−½ A M^−½, every diagonal entry stored
    ZeroModes zeros;
    LdltAnalysis analysis;
    ZeroModes zeros_in_order;   // of elimination
    SparseMatrix B_in_order() const;
    /// LDLᵀ of B − σI. @throws SolverError as LdltAnalysis::factor
    LdltPanels factor(double sigma, bool parallel) const { return analysis.factor(B, sigma, parallel); }
    int size() const { return static_cast<int>(B.rows()); }
};

/// Relative distance of two eigenvalues from which they are not one cluster: rounding may turn the members of a cluster about.
constexpr double clear_gap = 1e-5;

struct SliceGoal {
    double sigma = 0;
    double low = 0, high = 0;   // all eigenvalues between, and the whole cluster that `high` may cut
    int at_least = 0;           // pairs, else the slice goes on upwards
    double expected = 0;        // pairs, to know when looking for them begins to be worth it
    int below_sigma = -1;       // nonzero eigenvalues in [low, σ] if known: the slice is not finished before
    bool to_the_end = false;    // `high` lies above the whole spectrum
    int largest_basis = 0;
    double tolerance = 0;   // relative residual
    std::uint64_t seed = 0;
    bool parallel = false;
    bool polish = false;   // every solve refined
};

struct Slice {
    SliceGoal goal;
    bool complete = false;
    int counted = 0;               // eigenvalues below σ, by inertia
    double delta = 0;              // rounding of that count
    Vector mu;                     // ascending
    std::vector<EightColumns> X;   // the pairs' vectors in groups of eight, in the order of elimination
    double begin = 0, cut = 0;     // its own pairs: those above the cut of the slice before, up to the gap above the last
    SpectrumTimes times;
    int basis = 0;
};

/// Called after each step with the share done, in [0, 1]; may throw.
using StepReport = std::function<void(double)>;

/// @param locked  groups of eigenvectors known already, which are not found again
Slice solve_slice(const SpectrumProblem& problem, const SliceGoal& goal, const std::vector<const EightColumns*>& locked,
                  const StepReport& report);

/// Inertia at σ or, where a pivot is lost in rounding, a little beside it.
Inertia count_near(const SpectrumProblem& problem, double sigma);

}   // namespace meshfolio
