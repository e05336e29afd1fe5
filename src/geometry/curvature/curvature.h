/// @file
/// Discrete curvature at vertices. Coincident vertices (operators/coincident_vertices.h) share the curvature of the point they are: one
/// normal, one area, one angle deficit. Undefined values are NaN: on the boundary, at non-manifold or unreferenced vertices, for area ≤ 0.
#pragma once

#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

/// Returns n values ½‖Δ_uniform x‖ with the sign of −Δx · n: the coursework's uniform mean curvature. It is a *length*, not a curvature;
/// see uniform_mean_curvature_scaled(). NaN on the boundary and at non-manifold or unreferenced vertices. [length]
Vector uniform_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology);
/// Returns uniform_mean_curvature() times 4 / mean squared ring edge, comparable with the mean curvature H; NaN where that is. [1/length]
Vector uniform_mean_curvature_scaled(const TriangleMesh& mesh, const MeshTopology& topology);

/// Returns n values H = ±½‖Lx‖ from Δx = −2Hn, positive where the surface bends away from its normal, as spheres do. NaN on the boundary,
/// at non-manifold vertices and for masses ≤ 0. [1/length]
Vector cotangent_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const LaplaceBeltrami& laplacian);

/// Returns n angle deficits: 2π − Σθ inside; π − Σθ on the boundary, the turning of the boundary and no curvature; 0 at unreferenced
/// vertices. Their sum is 2πχ on every manifold mesh (Gauss–Bonnet). Coincident vertices keep a deficit each. [rad]
Vector angle_deficit(const TriangleMesh& mesh, const MeshTopology& topology);
/// Returns n values K = (2π − Σθ)/A_i from n areas; NaN on the boundary, at non-manifold vertices and for areas ≤ 0. [1/length²]
Vector gaussian_curvature(const TriangleMesh& mesh, const MeshTopology& topology, const Vector& areas);
/// Returns n values K = deficit/area from n angle deficits [rad] and n areas [length²], coincident vertices each with its own; NaN on the
/// boundary, at non-manifold vertices and for areas ≤ 0. [1/length²]
Vector gaussian_curvature(const MeshTopology& topology, const Vector& deficits, const Vector& areas);

}   // namespace meshfolio
