/// @file
/// Scores of a discrete Laplacian of any origin.
#pragma once

#include "geometry/linear/inertia.h"
#include "geometry/spectrum/definiteness.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

/// The scores of one operator on one mesh.
struct OperatorScores {
    double asymmetry = 0;         // max |C − Cᵀ|/max |C|
    Inertia negative;             // eigenvalues of −C below 0, with their rounding (mesh_laws.h)
    int weights = 0;              // pairs of vertices joined by C
    int negative_inside = 0;      // weights below −1e-9 of the largest, with an end inside
    int negative_boundary = 0;    // such weights with both ends on the boundary
    double smallest_weight = 0;   // smallest C_ij off the diagonal
    int without_mass = 0;         // vertices in use with M ≤ 0, which leave no L = M⁻¹C
    double lowest = 0;            // proved bound of μ_min/μ_max: upper if indefinite, else lower; NaN if vertices are without mass
    Definiteness::Verdict verdict = Definiteness::Verdict::undecided;   // on −C
    double critical = 0;   // λ_crit = 2/μ_max, the limit unless −C is indefinite; NaN if vertices are without mass [length²]
};
/// Computes the scores of an operator. @param assembly  prior knowledge of C (definiteness.h)
/// @throws SolverError if an eigenvalue cannot be computed
OperatorScores operator_scores(const LaplaceBeltrami& laplacian, const MeshTopology& topology, Assembly assembly = Assembly::unknown);

/// Returns the `count` smallest eigenvalues above zero, ascending; fewer on small meshes, none if vertices in use are without mass or the
/// solver fails, as for an indefinite −C. [1/length²]
Vector smallest_nonzero_eigenvalues(const LaplaceBeltrami& laplacian, const MeshTopology& topology, int count);

/// Returns max |μ_i/reference_i − 1| over the common indices; NaN if there is none.
double largest_relative_change(const Vector& eigenvalues, const Vector& reference);

/// Returns the largest ½‖(Lx)_i‖ over interior vertices with mass and all triangles in one plane, where 0 would be exact; NaN without such
/// vertices. [1/length]
double linear_precision(const LaplaceBeltrami& laplacian, const TriangleMesh& mesh, const MeshTopology& topology);

}   // namespace meshfolio
