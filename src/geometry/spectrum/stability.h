/// @file
/// The largest step of explicit smoothing X ← X + λLX: stable while λμ_max ≤ 2, without overshoot while λμ_max ≤ 1.
#pragma once

#include <string>

#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

/// The top mode of an operator.
struct LargestEigenvalue {
    double value = 0;         // μ_max of −M⁻¹C (or of −L): a Rayleigh quotient, so never above it but for rounding [1/length²]
    double upper_bound = 0;   // Gershgorin: max_i Σ_j |L_ij|, guaranteed
    Vector mode;              // n values of its eigenvector, M-normalised, the largest positive; a mixture of eigenvectors where
                              // eigenvalues crowd at the top, as on regular grids
    int vertex = -1;          // where |mode| is largest: a vertex that sets the limit
    double support = 0;       // (Σ Mφ²)²/Σ(Mφ²)²: the effective number of vertices in the mode
};

/// Computes the top mode by plain Lanczos, value and mode to 1e-13, if that converges soon, as on most meshes; else by the method of the
/// stability certificate, the value to 1e-8 or to rounding. Independent of the number of threads.
/// @throws MeshError as operator_with_mass(); SolverError if weights are not finite
LargestEigenvalue largest_eigenvalue(const LaplaceBeltrami& laplacian);
/// Computes the top mode without a factorisation, to 1e-9 on most meshes, for sequences of operators. Where eigenvalues crowd at the top,
/// the value is too small by some 1e-5; never too large but for rounding.
/// @param start  a mode to begin with, one value a vertex of the whole mesh, from a similar operator; empty: none
LargestEigenvalue largest_eigenvalue_nearly(const OperatorWithMass& whole, const Vector& start = {});

/// Returns max_i Σ_j |A_ij|/M_i ≥ every eigenvalue of M⁻¹A (Gershgorin), its rounding included.
double gershgorin_bound(const SparseMatrix& A, const Vector& M);

/// Returns the pair (mu, phi) as a top mode: phi M-normalised on all vertices, its vertex and support, and the Gershgorin bound.
/// @param phi  an eigenvector, one value a row of the operator; need not be normalised
LargestEigenvalue top_mode(const OperatorWithMass& whole, double mu, Vector phi);

/// Returns λ_crit = 2/μ_max; infinity if μ_max is 0. [length²] (dimensionless for the uniform operator)
double largest_stable_step(const LargestEigenvalue& top);

/// The unit of λ in input. raw: [length²]; tau: λμ_max/2, so that 1 is the limit; h2: λ / mean edge².
enum class StepUnit { raw, tau, h2 };
/// Returns the unit named "raw", "tau" or "h2". @throws UsageError for other names
StepUnit step_unit_named(const std::string& name);
/// Returns the step in [length²]: λ for raw, λ · critical for tau, λ · mean_edge² for h2. @param critical  λ_crit; not used for raw and h2
double step_in_model_units(double lambda, StepUnit unit, double critical, double mean_edge);

/// A step as raw [length²], as tau (a share of λ_crit) and as h2 (over the squared mean edge).
struct StepInUnits {
    double raw = 0, tau = 0, h2 = 0;
};
/// Returns the step `raw` [length²] in all units. @param critical  λ_crit [length²] @param mean_edge  [length]
StepInUnits step_in_units(double raw, double critical, double mean_edge);

/// Returns the reach of smoothing: the width √(4λt) of the heat kernel after the diffusion time λt, over the box diagonal.
double smoothing_strength(double diffusion_time, double diagonal);

}   // namespace meshfolio
