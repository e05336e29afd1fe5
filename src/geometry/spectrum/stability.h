/// @file
/// How large a step explicit smoothing X ← X + λLX can take: stable while λμ_max ≤ 2, without overshoot while λμ_max ≤ 1.
#pragma once

#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

struct LargestEigenvalue {
    double value = 0;         // μ_max of −M⁻¹C (or of −L): a Rayleigh quotient, so never above it but for rounding [1/length²]
    double upper_bound = 0;   // Gershgorin: max_i Σ_j |L_ij|, guaranteed
    Vector mode;              // its eigenvector, M-normalised, largest entry positive; where eigenvalues crowd at the top, as on regular
                              // grids, a mixture of their eigenvectors: the value is right, the mode is one of many
    int vertex = -1;          // where |mode| is largest: the vertex that sets the limit, or one of those that do
    double support = 0;       // (Σ Mφ²)²/Σ(Mφ²)²: how many vertices share the mode
};

/// By plain Lanczos, value and mode to 1e-13, where that ends soon, as on most meshes; else as the stability certificate does, the value to
/// 1e-8 or what rounding leaves, the mode by solves with the factor just above. Threads do not change it.
/// @throws MeshError as operator_with_mass; SolverError if weights are not finite
LargestEigenvalue largest_eigenvalue(const LaplaceBeltrami& laplacian);
/// Without any factorisation, to 1e-9 on most meshes: for operators that come one after the other. Where eigenvalues crowd at the top, too
/// small by some 1e-5; never too large but for rounding.
/// @param start  a mode to begin with, one value a vertex of the whole mesh: that of an operator nearby; empty: none
LargestEigenvalue largest_eigenvalue_nearly(const OperatorWithMass& whole, const Vector& start = {});

/// What plain Lanczos knows of the top among the vertices with mass: where both begin, and the certificate too.
struct TopEstimate {
    double mu = 0;         // [1/length²]
    Vector phi;            // not normalised
    double change = 0;     // how much the last third of the steps raised μ, relative: about what may still be missing
    double residual = 0;   // of the vector, relative
};
struct TopSearch {
    double change = 1e-13, residual = 1;   // at which to stop
    int most_steps = 250;
};
TopEstimate top_estimate(const OperatorWithMass& whole, const TopSearch& search = {}, const Vector& start = {});

/// max_i Σ_j |A_ij|/M_i ≥ every eigenvalue of M⁻¹A (Gershgorin), its own rounding included: guaranteed, and O(entries).
double gershgorin_bound(const SparseMatrix& A, const Vector& M);

/// A unit vector with a little of every mode: no symmetry of a mesh makes it orthogonal to one. The same on every machine.
Vector irregular_direction(int n);

/// An eigenpair of the operator among the vertices with mass, described as above. `phi` need not be normalised.
LargestEigenvalue top_mode(const OperatorWithMass& whole, double mu, Vector phi);

/// λ_crit = 2/μ_max. [length²] (dimensionless for the uniform operator)
double largest_stable_step(const LargestEigenvalue& top);

/// The unit a user gives λ in. raw: [length²]; tau: λμ_max/2, so that 1 is the limit; h2: λ / mean edge².
enum class StepUnit { raw, tau, h2 };
StepUnit step_unit_named(const std::string& name);
double step_in_model_units(double lambda, StepUnit unit, double critical, double mean_edge);

/// One step in all its units. [length²], 1, 1
struct StepInUnits {
    double raw = 0, tau = 0, h2 = 0;
};
StepInUnits step_in_units(double raw, double critical, double mean_edge);

/// How far smoothing reaches: the width √(4λt) of the heat kernel after the diffusion time λt, as a share of the box diagonal.
double smoothing_strength(double diffusion_time, double diagonal);

}   // namespace meshfolio
