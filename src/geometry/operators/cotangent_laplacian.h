/// @file
/// The cotangent Laplace–Beltrami operator L = M⁻¹C (Pinkall & Polthier 1993; Meyer et al. 2003).
///   C_ij = ½(cot α_ij + cot β_ij),  C_ii = −Σ_j C_ij,  M = diag(A_i)
/// C is symmetric negative semidefinite, Δx = −2Hn.
///
/// The core is intrinsic: it sees glued triangles and the cotangents of their corners, whether these come from vertex
/// positions or from edge lengths alone (a flat torus, an intrinsic Delaunay triangulation, a tufted cover).
#pragma once

#include "geometry/linear/sparse_types.h"
#include "geometry/operators/coincident_vertices.h"
#include "geometry/operators/vertex_areas.h"

namespace meshfolio {

struct CotangentOptions {
    /// The weight of an edge with n opposite corners. `sum`: ½ Σ cot, the finite-element matrix. `mean`: (1/n) Σ cot, which is the same at
    /// manifold interior edges and doubles boundary weights.
    enum class OppositeVertices { sum, mean } opposite = OppositeVertices::sum;
    /// Negative edge weights become 0. Keeps C negative semidefinite, gives up linear precision.
    bool clamp_negative = false;
};

/// m × 3 cotangents from positions: (u · v)/|u × v|, and 0 in triangles without area (mesh/triangle_kind.h), which bound no surface and so
/// have no Dirichlet energy.
CornerValues corner_cotangents(const TriangleMesh& mesh);
/// The same from the m × 3 edge lengths of intrinsic triangles: (b² + c² − a²)/(4A) with Kahan's form of Heron's A.
/// @throws MeshError if a length is negative or not finite
CornerValues corner_cotangents(const CornerValues& lengths);

/// C, n × n, from triangles and the cotangents of their corners; every diagonal entry is stored. [dimensionless]
/// Corners of a triangle may be the same vertex, and several edges may join the same two vertices, whose weight is then
/// that of all their opposite corners together; an edge from a vertex to itself has no effect.
/// @throws MeshError if the sizes do not fit or an index is not a vertex
SparseMatrix cotangent_stiffness(const Faces& F, int vertex_count, const CornerValues& cotangents, const CotangentOptions& options = {});

struct LaplaceBeltrami {
    SparseMatrix C;   // n × n; of coincident vertices, the first has the row of all, the others have rows of zeros
    Vector M;         // n lumped masses A_i; 0 at unreferenced vertices; coincident vertices share theirs equally [length²]
    std::vector<VertexCopy> copies = {};   // coincident_vertices() of the mesh
};
/// assemble(mesh) of the mesh with its coincident vertices joined. @param longest  of the edges that have no length
template <class Assemble>
LaplaceBeltrami assembled_joined(const TriangleMesh& mesh, Assemble assemble, double longest = no_length) {
    std::vector<VertexCopy> copies = coincident_vertices(mesh, longest);
    if (copies.empty()) return assemble(mesh);
    LaplaceBeltrami laplacian = assemble(with_joined_vertices(mesh, copies));
    share_equally(copies, laplacian.M);
    laplacian.copies = std::move(copies);
    return laplacian;
}
LaplaceBeltrami laplace_beltrami(const TriangleMesh& mesh, AreaForm area = AreaForm::barycentric, const CotangentOptions& options = {});
/// Keeps a stiffness for triangles without area, cotangents cut off at 1/no_area, to show what that does to the largest stable step.
LaplaceBeltrami floored_laplace_beltrami(const TriangleMesh& mesh, AreaForm area = AreaForm::barycentric);
/// The same as laplace_beltrami of glued intrinsic triangles with m × 3 edge lengths.
LaplaceBeltrami laplace_beltrami(const Faces& F, int vertex_count, const CornerValues& lengths, AreaForm area = AreaForm::barycentric,
                                 const CotangentOptions& options = {});

/// The per-edge normalised variant of one earlier report (after Vallet & Lévy 2008): L_ij = (cot α + cot β)/(A_i + A_j),
/// rows sum to 0, barycentric areas. Symmetric, not linearly precise; here to be compared with, not to be used. [1/length²]
SparseMatrix edge_normalised_laplacian(const TriangleMesh& mesh, bool clamp_negative = true);

}   // namespace meshfolio
