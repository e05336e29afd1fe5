/// @file
/// What can be said of a discrete Laplacian without knowing where it comes from.
#pragma once

#include "geometry/linear/inertia.h"
#include "geometry/spectrum/definiteness.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

struct OperatorScores {
    double asymmetry = 0;         // as the law of the same name: max |C − Cᵀ|/max |C|
    Inertia negative;             // eigenvalues of −C below 0, with their rounding (mesh_laws.h)
    int weights = 0;              // pairs of vertices joined by C
    int negative_inside = 0;      // of them, with a weight below −1e-9 of the largest and an end that is not on the boundary
    int negative_boundary = 0;    // the same with both ends on the boundary
    double smallest_weight = 0;   // smallest C_ij off the diagonal
    int without_mass = 0;         // vertices in use with M ≤ 0, which leave no L = M⁻¹C
    double lowest = 0;            // proved bound of μ_min/μ_max: above it where indefinite, below it elsewhere; NaN without mass
    Definiteness::Verdict verdict = Definiteness::Verdict::undecided;   // on −C
    double critical = 0;   // λ_crit = 2/μ_max, the limit unless −C is indefinite; NaN where vertices are without mass [length²]
};
/// @throws SolverError if an eigenvalue cannot be computed
OperatorScores operator_scores(const LaplaceBeltrami& laplacian, const MeshTopology& topology, Assembly assembly = Assembly::unknown);

/// The `count` smallest eigenvalues above zero, ascending; fewer on meshes with fewer, none where vertices are without mass. [1/length²]
Vector smallest_nonzero_eigenvalues(const LaplaceBeltrami& laplacian, const MeshTopology& topology, int count);

/// max |μ_i/reference_i − 1| over the values both have; NaN when there is none.
double largest_relative_change(const Vector& eigenvalues, const Vector& reference);

/// Largest ½‖(Lx)_i‖ over vertices whose triangles lie in one plane, where linear functions should give 0; NaN without any. [1/length]
double linear_precision(const LaplaceBeltrami& laplacian, const TriangleMesh& mesh, const MeshTopology& topology);

}   // namespace meshfolio
