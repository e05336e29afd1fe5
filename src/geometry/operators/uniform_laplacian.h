/// @file
/// The umbrella operator: (Δx)_i = mean of the one-ring − x_i. Dimensionless; symmetric only on regular meshes.
#pragma once

#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

/// Returns the n × n matrix with rows that sum to 0: −1 on the diagonal, 1/valence for neighbours. Rows of unreferenced vertices are zero.
SparseMatrix uniform_laplacian(const MeshTopology& topology);
/// Returns the umbrella operator as M⁻¹C with the valences as masses: C, the graph Laplacian, is symmetric.
LaplaceBeltrami uniform_operator(const MeshTopology& topology);
/// Returns the umbrella operator, with valences as masses, of the mesh with its coincident vertices joined. It ignores lengths, so it jumps
/// as a gap closes; vertices at the same point are joined all the same, because a point has one motion. @param topology  of the mesh as it
/// is
LaplaceBeltrami uniform_operator(const TriangleMesh& mesh, const MeshTopology& topology);

/// Returns n values, the mean of |x_j − x_i|² over the one-ring of i; 0 at unreferenced vertices. [length²]
/// Δ_uniform x ≈ −½ H h² n with h² this mean, so 4/h² turns ½‖Δ_uniform x‖ (a length) into a curvature.
Vector mean_squared_ring_edge(const TriangleMesh& mesh, const MeshTopology& topology);

}   // namespace meshfolio
