/// @file
/// How large a step explicit smoothing X ← X + λLX can take: stable while λμ_max ≤ 2, without overshoot while λμ_max ≤ 1.
#pragma once

#include "geometry/cotangent_laplacian.h"

namespace meshfolio {

struct LargestEigenvalue {
    double value = 0;         // μ_max of −M⁻¹C (or of −L), by Lanczos [1/length²]
    double upper_bound = 0;   // Gershgorin: max_i Σ_j |L_ij|, guaranteed
    Vector mode;              // its eigenvector, M-normalised, largest entry positive
    int vertex = -1;          // where |mode| is largest: the vertex that sets the limit
    double support = 0;       // (Σ Mφ²)²/Σ(Mφ²)²: how many vertices share the mode
};

/// @throws SolverError if Lanczos does not converge
LargestEigenvalue largest_eigenvalue(const LaplaceBeltrami& laplacian);
/// For the uniform operator, which is symmetrised by the valences (its spectrum lies in [0, 2]).
LargestEigenvalue largest_eigenvalue_uniform(const SparseMatrix& uniform, const Vector& valence);

/// λ_crit = 2/μ_max. [length²] (dimensionless for the uniform operator)
double largest_stable_step(const LargestEigenvalue& top);

/// The unit a user gives λ in. raw: [length²]; tau: λμ_max/2, so that 1 is the limit; h2: λ / mean edge².
enum class StepUnit { raw, tau, h2 };
StepUnit step_unit_named(const std::string& name);
double step_in_model_units(double lambda, StepUnit unit, double critical, double mean_edge);

}   // namespace meshfolio
