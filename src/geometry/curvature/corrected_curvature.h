/// @file
/// Interpolated corrected curvature (Lachaud, Romon, Thibert & Coeurjolly 2020): measures of area and curvature of a triangle mesh with
/// normals given at its vertices and interpolated between them. The curvatures are as good as these normals.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct CorrectedCurvature {
    Vector H, K;   // n values, one a vertex: mean [1/length], Gaussian [1/length²]
};

/// Returns H = Σμ₁/(2Σμ₀) and K = Σμ₂/Σμ₀ at each vertex, summed over the triangles around it, with normals u and their mean ū,
///   μ₀ = ½⟨ū | (x_j − x_i) × (x_k − x_i)⟩
///   μ₁ = ½⟨ū | (u_k − u_j) × x_i + (u_i − u_k) × x_j + (u_j − u_i) × x_k⟩   (2H a unit of area)
///   μ₂ = ½⟨u_i | u_j × u_k⟩.
/// NaN at unreferenced and non-manifold vertices, and where Σμ₀ ≤ 0.
/// @param normals  n × 3, unit
/// @throws MeshError if there are not as many normals as vertices, or the topology is of another mesh
CorrectedCurvature corrected_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals);

/// The weight of a triangle's normal at one of its vertices.
enum class NormalWeights {
    area,
    angle,
    sphere   // sin θ/(|a||b|), a and b the edges at the vertex (Max 1999): exact for any points on a sphere
};
/// Returns n × 3 unit normals, weighted means over the triangles around each vertex; (0, 0, 0) at vertices without area.
Positions weighted_vertex_normals(const TriangleMesh& mesh, NormalWeights weights);

}   // namespace meshfolio
