/// @file
/// Interpolated corrected curvature (Lachaud, Romon, Thibert & Coeurjolly 2020): the measures of area and curvature of a triangle mesh
/// whose normals are given at the vertices and interpolated between them. As good as these normals are.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct CorrectedCurvature {
    Vector H, K;   // [1/length], [1/length²]
};

/// At a vertex, H = Σμ₁/(2Σμ₀) and K = Σμ₂/Σμ₀ over the triangles around it, with normals u and their mean ū,
///   μ₀ = ½⟨ū | (x_j − x_i) × (x_k − x_i)⟩
///   μ₁ = ½⟨ū | (u_k − u_j) × x_i + (u_i − u_k) × x_j + (u_j − u_i) × x_k⟩   (2H a unit of area)
///   μ₂ = ½⟨u_i | u_j × u_k⟩.
/// NaN at unreferenced and non-manifold vertices, and where Σμ₀ ≤ 0.
/// @param normals  n × 3, unit
/// @throws MeshError if there are not as many normals as vertices, or the topology is of another mesh
CorrectedCurvature corrected_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals);

/// How a vertex weights the unit normals of the triangles around it.
enum class NormalWeights {
    area,
    angle,
    sphere   // sin θ/(|a||b|), a and b the edges at the vertex (Max 1999): exact for any points on a sphere
};
/// n × 3 unit normals; (0, 0, 0) at vertices without area.
Positions weighted_vertex_normals(const TriangleMesh& mesh, NormalWeights weights);

}   // namespace meshfolio
