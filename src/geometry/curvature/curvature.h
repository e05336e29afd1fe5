/// @file
/// Discrete curvature at vertices. Coincident vertices (operators/coincident_vertices.h) have that of the point they are: one normal, one
/// area, one angle deficit. Undefined values (boundary, non-manifold or unreferenced vertices, area ≤ 0) are NaN.
#pragma once

#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

/// ½‖Δ_uniform x‖ with the sign of −Δx · n: what the coursework calls the uniform mean curvature. A *length*, not a curvature;
/// see uniform_mean_curvature_scaled. Boundary vertices are NaN. [length]
Vector uniform_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology);
/// The same times 4 / mean squared ring edge: comparable with H. [1/length]
Vector uniform_mean_curvature_scaled(const TriangleMesh& mesh, const MeshTopology& topology);

/// H = sign · ½‖L x‖ from Δx = −2Hn, positive where the surface bends away from its normal (a sphere with outward normals). [1/length]
Vector cotangent_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const LaplaceBeltrami& laplacian);

/// Angle deficit: 2π − Σθ inside, π − Σθ on the boundary, where it is the turning of the boundary and not curvature. n values, 0 at
/// unreferenced vertices. Their sum is 2πχ on every manifold mesh (Gauss–Bonnet). Each of coincident
/// vertices has its own here. [rad]
Vector angle_deficit(const TriangleMesh& mesh, const MeshTopology& topology);
/// K = (2π − Σθ)/A_i; NaN on the boundary. [1/length²]
Vector gaussian_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const Vector& areas);
/// The same from angle_deficit() vertex by vertex, which several choices of areas share. @param deficits  n [rad] @param areas  n [length²]
Vector gaussian_curvature(const MeshTopology& topology, const Vector& deficits, const Vector& areas);

}   // namespace meshfolio
