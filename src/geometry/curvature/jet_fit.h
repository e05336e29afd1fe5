/// @file
/// Curvature from osculating jets (Cazals & Pouget 2005): the surface around a vertex is a polynomial height over a plane.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct JetCurvature {
    Vector H, K;   // a value a vertex: mean [1/length], Gaussian [1/length²]; H > 0 where the surface bends away from its normal
};

/// Returns H and K of the degree-3 polynomial that fits, in least squares, the heights of a vertex and its two rings over the plane of its
/// area-weighted normal. Second derivatives are O(h²) on any triangulation of points on a smooth surface. Boundary vertices have a jet
/// from the side of their neighbours.
/// Up to three rings are taken where two do not determine the polynomial, or would turn its residual into curvature, as long thin triangles
/// do. NaN where these do not help, where there are fewer than ten points, and at non-manifold vertices.
/// @throws MeshError if the topology is of another mesh
JetCurvature jet_curvature(const TriangleMesh& mesh, const MeshTopology& topology);

}   // namespace meshfolio
