/// @file
/// Identities that hold on every mesh, and the deviations of a mesh and its operator from them. They need no known surface: a wrong sign, a
/// lost factor or a reversed triangle shows on any mesh.
#pragma once

#include "geometry/linear/inertia.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

/// Returns the largest |C_ij − C_ji| over the largest |C_ij|; 0 for an empty C.
double asymmetry(const SparseMatrix& C);

/// Returns the largest |Σ_j C_ij| over the largest |C_ij|: 0 up to rounding, as a constant function has no Laplacian.
double row_sum_error(const SparseMatrix& C);

/// Returns the Dirichlet energy of the positions over the surface area: 1 up to rounding for cotangents on every mesh (Pinkall & Polthier
/// 1993).
double energy_over_area(const TriangleMesh& mesh, const SparseMatrix& C);

/// Returns the largest ‖(CX)_i + ∇_i area‖ over Σ_j |C_ij|‖x_j − x_i‖: 0 up to rounding, as cotangents are the first variation of the area.
/// The gradient comes from normals and edges, without cotangents.
double first_variation_error(const TriangleMesh& mesh, const SparseMatrix& C);

/// Returns ΣM over the area of the triangles, without triangles of zero area (triangle_kind.h): 1 up to rounding.
double mass_over_area(const TriangleMesh& mesh, const Vector& M);

/// Counts the eigenvalues of −Cx = νDx below σ = −1e-10, D its diagonal, with the rounding of the count: none if −C is positive
/// semidefinite. The sign does not depend on the weights D > 0 (Sylvester). Rows with a diagonal entry 0 get the largest one for D.
/// @throws SolverError if a pivot is lost in rounding
Inertia negative_eigenvalues(const SparseMatrix& C);
/// Judges the count of negative_eigenvalues(). refuted: −C has an eigenvalue < 0; proved: it has none below −2e-10 D; undecided: the
/// rounding of the count is 1e-10 or more.
Proof semidefinite(const Inertia& negative);

/// Counts half-edges that run from and to the vertices of an earlier one: 0 if all triangles are oriented alike and no edge has more than
/// two.
int repeated_half_edges(const Faces& F);

/// Returns ‖Σ_t A_t n_t‖ over the surface area: 0 for closed, consistently oriented surfaces.
double flux_over_area(const TriangleMesh& mesh);

/// Returns the sum of the angle deficits, in extended precision: thousands of components would add rounding of their own. [rad]
double total_deficit(const Vector& angle_deficits);
/// Returns |Σ angle deficits / 2π − χ|: 0 on manifold meshes, with or without boundary (Gauss–Bonnet).
double gauss_bonnet_error(const Vector& angle_deficits, int euler_characteristic);
/// Returns 1e-12 + 1e-15 · triangles, the rounding that gauss_bonnet_error() may have.
double gauss_bonnet_tolerance(int triangles);

}   // namespace meshfolio
