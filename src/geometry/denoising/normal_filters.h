/// @file
/// Denoising in two stages: filter the face normals so that edges stay, then move the vertices until the faces have them.
///   Zheng et al. 2011, bilateral normal filtering; Zhang et al. 2015, guided normal filtering; Sun et al. 2007, vertex update.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// The triangles around each triangle.
struct FaceRings {
    Incidence by_vertex;   // row t: triangles that share a vertex with t, itself among them, ascending
    Incidence by_edge;     // row t: triangles that share an edge with t, ascending; not itself
};
FaceRings face_rings(const TriangleMesh& mesh);

/// m × 3 centroids. [length]
Positions face_centroids(const TriangleMesh& mesh);

/// Weights of the bilateral filter that do not change with the normals: of the triangles s that share a vertex with t (t itself among
/// them), A_s exp(−|c_s − c_t|²/2σ_c²), σ_c the mean distance between centroids of triangles that share an edge. [length²]
struct NormalKernel {
    FaceRings rings;
    std::vector<double> weights;   // one an item of rings.by_vertex
};
NormalKernel normal_kernel(const TriangleMesh& mesh);
NormalKernel normal_kernel(const TriangleMesh& mesh, FaceRings rings);

/// n_t ← Σ_s w_ts exp(−|g_s − g_t|²/2σ_r²) n_s, made a unit vector; stays where the sum is zero.
/// @param N        m × 3 unit normals
/// @param guide    m × 3: which differences count. N itself: the bilateral filter; guiding_normals(): the guided one
/// @param sigma_r  differences of unit normals beyond which two faces belong to different sides of an edge [1]
/// @throws MeshError for sigma_r that is not positive
Positions filtered_normals(const NormalKernel& kernel, const Positions& N, const Positions& guide, double sigma_r);

/// Of each triangle the mean normal, by area, of the most consistent of the patches that contain it. A patch is a triangle and those that
/// share a vertex with it; the inconsistency of one is H = Φ R, Φ the largest difference of two of its normals, R the largest difference
/// across one of its inner edges over their sum (Zhang et al. 2015, eqs. 6 to 9).
Positions guiding_normals(const TriangleMesh& mesh, const FaceRings& rings, const Positions& N);

/// x_i ← x_i + 1/|F_i| Σ_{t∋i} n_t (n_t · (c_t − x_i)), `sweeps` times, all vertices at once (Sun et al. 2007, eq. 10). A step down the
/// gradient of the distances by which edges miss being orthogonal to the given normals.
/// @param N  m × 3; triangles with a normal of zero do not count
Positions moved_to_normals(const TriangleMesh& mesh, const Incidence& vertex_faces, const Positions& N, int sweeps);

}   // namespace meshfolio
