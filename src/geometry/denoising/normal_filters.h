/// @file
/// Denoising in two stages: filter the face normals so that edges stay, then move the vertices until the faces have them.
///   Zheng et al. 2011, bilateral normal filtering; Zhang et al. 2015, guided normal filtering; Sun et al. 2007, vertex update.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// The triangles around each triangle t; the rows ascend.
struct FaceRings {
    Incidence by_vertex;   // triangles that share a vertex with t, including t
    Incidence by_edge;     // triangles that share an edge with t, excluding t
};
/// Returns, for each triangle, the triangles that share a vertex or an edge with it.
FaceRings face_rings(const TriangleMesh& mesh);

/// Returns the m × 3 centroids of the triangles. [length]
Positions face_centroids(const TriangleMesh& mesh);

/// The weights of the bilateral filter that do not depend on the normals: A_s exp(−|c_s − c_t|²/2σ_c²) for the triangles s that share a
/// vertex with t, where σ_c is the mean distance between centroids of triangles that share an edge. [length²]
struct NormalKernel {
    FaceRings rings;
    std::vector<double> weights;   // one an item of rings.by_vertex
};
/// Returns the rings of the mesh and the weights of the bilateral filter.
NormalKernel normal_kernel(const TriangleMesh& mesh);
/// Returns the weights of the bilateral filter with known rings. @param rings  face_rings(mesh)
NormalKernel normal_kernel(const TriangleMesh& mesh, FaceRings rings);

/// Returns the m × 3 unit vectors along Σ_s w_ts exp(−|g_s − g_t|²/2σ_r²) n_s; a normal stays where the sum is zero.
/// @param N        m × 3 unit normals
/// @param guide    m × 3 vectors g: N itself for the bilateral filter, guiding_normals() for the guided one
/// @param sigma_r  differences of unit normals beyond which two faces belong to different sides of an edge [1]
/// @throws MeshError if sigma_r is not positive
Positions filtered_normals(const NormalKernel& kernel, const Positions& N, const Positions& guide, double sigma_r);

/// Returns for each triangle the area-weighted mean normal of the most consistent patch that contains it, m × 3. A patch is a triangle and
/// those that share a vertex with it. Its inconsistency is H = Φ R: Φ the largest difference of two of its normals, R the largest
/// difference across one of its inner edges over their sum (Zhang et al. 2015, eqs. 6 to 9).
Positions guiding_normals(const TriangleMesh& mesh, const FaceRings& rings, const Positions& N);

/// Returns positions after `sweeps` updates x_i ← x_i + 1/|F_i| Σ_{t∋i} n_t (n_t · (c_t − x_i)), all vertices at once (Sun et al. 2007,
/// eq. 10): steps down the gradient of the distances by which edges miss being orthogonal to the given normals.
/// @param N  m × 3; triangles with a normal of zero do not count
Positions moved_to_normals(const TriangleMesh& mesh, const Incidence& vertex_faces, const Positions& N, int sweeps);

}   // namespace meshfolio
