/// @file
/// The largest eigenvalue by plain Lanczos: one recurrence, no restart, no reorthogonalisation. Lost orthogonality brings copies of
/// eigenvalues but never one above the largest (Paige 1980). Private to the layer.
///
/// Spectra's SymEigsSolver, stopped before it converges, takes 0.5 to 0.9 of the time, but gives no value then; read from its Ritz pairs,
/// the value was 1e83 for an operator of the adaptive flow of question 5's open sheet (StabilitySection.RealMeshes).
#pragma once

#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

/// The largest eigenpair of M⁻¹A, estimated.
struct TopEstimate {
    double mu = 0;         // a Rayleigh quotient: never above μ_max but for rounding [1/length²]
    Vector phi;            // among the vertices with mass, not normalised
    double change = 0;     // how much the last third of the steps raised μ, relative: about the error; 0 where they filled the space
    double residual = 0;   // of the vector, relative
};

/// Conditions to stop, and the largest number of products with the matrix.
struct TopSearch {
    double change = 1e-13, residual = 1;
    int most_steps = 250;
};

/// Estimates the top by Lanczos; exactly, by a dense solver, on small meshes.
/// @param start  a mode to begin with, one value a vertex of the whole mesh; empty: irregular_direction()
/// @throws SolverError if weights are not finite
TopEstimate top_estimate(const OperatorWithMass& whole, const TopSearch& search = {}, const Vector& start = {});

/// Returns a fixed unit vector of n entries with a part in every mode: no symmetry of a mesh makes it orthogonal to one.
Vector irregular_direction(int n);

}   // namespace meshfolio
