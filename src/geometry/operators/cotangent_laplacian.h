/// @file
/// The cotangent Laplace–Beltrami operator L = M⁻¹C (Pinkall & Polthier 1993; Meyer et al. 2003).
///   C_ij = ½(cot α_ij + cot β_ij),  C_ii = −Σ_j C_ij,  M = diag(A_i)
/// C is symmetric negative semidefinite, Δx = −2Hn.
///
/// The core is intrinsic: it needs glued triangles and the cotangents of their corners, from vertex positions or from edge lengths alone
/// (a flat torus, an intrinsic Delaunay triangulation, a tufted cover).
#pragma once

#include "geometry/linear/sparse_types.h"
#include "geometry/operators/coincident_vertices.h"
#include "geometry/operators/vertex_areas.h"

namespace meshfolio {

struct CotangentOptions {
    /// The weight of an edge with n opposite corners. `sum`: ½ Σ cot, the finite-element matrix. `mean`: (1/n) Σ cot, which is the same at
    /// manifold interior edges and doubles boundary weights.
    enum class OppositeVertices { sum, mean } opposite = OppositeVertices::sum;
    /// Replaces negative edge weights by 0. Keeps C negative semidefinite, gives up linear precision.
    bool clamp_negative = false;
};

/// Returns m × 3 cotangents (u · v)/|u × v|; 0 in triangles without area (mesh/triangle_kind.h), which have no Dirichlet energy.
CornerValues corner_cotangents(const TriangleMesh& mesh);
/// Returns m × 3 cotangents from m × 3 edge lengths: (b² + c² − a²)/(4A) with Kahan's form of Heron's A.
/// @throws MeshError if a length is negative or not finite
CornerValues corner_cotangents(const CornerValues& lengths);

/// Returns C, n × n, from triangles and the cotangents of their corners; every diagonal entry is stored. [dimensionless]
/// Corners of a triangle may be the same vertex; an edge from a vertex to itself has no effect. Where several edges join the same two
/// vertices, their weights add up.
/// @throws MeshError if the sizes do not fit or an index is not a vertex
SparseMatrix cotangent_stiffness(const Faces& F, int vertex_count, const CornerValues& cotangents, const CotangentOptions& options = {});

/// The operator L = M⁻¹C.
struct LaplaceBeltrami {
    SparseMatrix C;   // n × n; the first of coincident vertices has the row of all, the others have zeros
    Vector M;         // n lumped masses A_i; 0 at unreferenced vertices; coincident vertices share theirs equally [length²]
    std::vector<VertexCopy> copies = {};   // coincident_vertices() of the mesh
};
/// Returns assemble(mesh) for the mesh with its coincident vertices joined. @param longest  the largest relative length that counts as none
template <class Assemble> LaplaceBeltrami assembled_joined(const TriangleMesh& mesh, Assemble assemble, double longest = no_length) {
    std::vector<VertexCopy> copies = coincident_vertices(mesh, longest);
    if (copies.empty()) return assemble(mesh);
    LaplaceBeltrami laplacian = assemble(with_joined_vertices(mesh, copies));
    share_equally(copies, laplacian.M);
    laplacian.copies = std::move(copies);
    return laplacian;
}
/// Returns C and M of a mesh, its coincident vertices joined.
LaplaceBeltrami laplace_beltrami(const TriangleMesh& mesh, AreaForm area = AreaForm::barycentric, const CotangentOptions& options = {});
/// Returns C and M with a stiffness for triangles without area, cotangents cut off at 1/no_area, to show the effect of such triangles on
/// the largest stable step.
LaplaceBeltrami floored_laplace_beltrami(const TriangleMesh& mesh, AreaForm area = AreaForm::barycentric);
/// Returns C and M of glued intrinsic triangles with m × 3 edge lengths.
LaplaceBeltrami laplace_beltrami(const Faces& F, int vertex_count, const CornerValues& lengths, AreaForm area = AreaForm::barycentric,
                                 const CotangentOptions& options = {});

/// Returns the variant normalised per edge (after Vallet & Lévy 2008), n × n: L_ij = (cot α + cot β)/(A_i + A_j), rows summing to 0,
/// barycentric areas. Symmetric, not linearly precise; for comparison only. [1/length²]
SparseMatrix edge_normalised_laplacian(const TriangleMesh& mesh, bool clamp_negative = true);

}   // namespace meshfolio
