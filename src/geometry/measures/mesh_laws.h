/// @file
/// Identities that hold on every mesh, whatever its shape, and how far a mesh and its operator are from them. They need no known
/// surface: a wrong sign, a lost factor or a triangle the wrong way round shows wherever it is.
#pragma once

#include "geometry/linear/inertia.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

/// Largest |C_ij − C_ji| over the largest |C_ij|; 0 for an empty C.
double asymmetry(const SparseMatrix& C);

/// Largest |Σ_j C_ij| over the largest |C_ij|: a constant function has no Laplacian.
double row_sum_error(const SparseMatrix& C);

/// Dirichlet energy of the positions over the surface area: 1 on every mesh (Pinkall & Polthier 1993).
double energy_over_area(const TriangleMesh& mesh, const SparseMatrix& C);

/// Largest ‖(CX)_i + ∇_i area‖ over Σ_j |C_ij|‖x_j − x_i‖: the cotangents are the first variation of the area. The gradient is taken
/// from normals and edges, without a cotangent.
double first_variation_error(const TriangleMesh& mesh, const SparseMatrix& C);

/// ΣM over the area of the triangles that have any (triangle_kind.h): 1.
double mass_over_area(const TriangleMesh& mesh, const Vector& M);

/// Eigenvalues of −Cx = νDx below σ = −1e-10, D its diagonal, with the rounding of the count: none where −C is positive semidefinite, which
/// other weights > 0 would not change (Sylvester). Rows whose diagonal entry is 0 get its largest for D.
/// @throws SolverError if a pivot is lost in rounding
Inertia negative_eigenvalues(const SparseMatrix& C);
/// refuted: −C has an eigenvalue < 0; proved: it has none below −2e-10 D.
Proof semidefinite(const Inertia& negative);

/// Half-edges that run the same way as an earlier one: none where all triangles are oriented alike and edges have at most two.
int repeated_half_edges(const Faces& F);

/// ‖Σ_t A_t n_t‖ over the surface area: 0 for closed surfaces that are oriented consistently.
double flux_over_area(const TriangleMesh& mesh);

/// Σ of the angle deficits, added up with more digits: thousands of components would add rounding of their own. [rad]
double total_deficit(const Vector& angle_deficits);
/// |Σ angle deficits / 2π − χ|: 0 on manifold meshes, with or without boundary (Gauss–Bonnet).
double gauss_bonnet_error(const Vector& angle_deficits, int euler_characteristic);
/// What rounding of the angles may leave of it.
double gauss_bonnet_tolerance(int triangles);

}   // namespace meshfolio
