/// @file
/// The triangles around a vertex unfolded into a plane: the geometry of angle deficits and areas, for diagrams.
#pragma once

#include <vector>

#include "geometry/operators/vertex_areas.h"
#include "mesh/mesh_topology.h"
#include "report/diagram.h"

namespace meshfolio {

/// Returns the neighbours of an inner vertex counter-clockwise, from the smallest index.
std::vector<int> ring_in_order(const TriangleMesh& mesh, const MeshTopology& topology, int vertex);

/// A one-ring cut along its first edge and unfolded about the vertex, which lies at the origin. Lengths and angles at the vertex are kept.
struct FlatRing {
    std::vector<report::DiagramPoint> corners;   // the neighbours; at the end the first again, turned by Σθ
    std::vector<double> angles;                  // θ of each triangle [rad]
    double gap() const;                          // 2π − Σθ

    int triangles() const { return static_cast<int>(angles.size()); }
};
/// Unfolds the ring of an inner vertex from its neighbour of smallest index. @param start  direction of the edge to that neighbour [rad]
FlatRing flat_ring(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, double start = 0);

/// Returns the polygon of the vertex's cell in triangle t. Its signed area is the triangle's share of vertex_areas().
std::vector<report::DiagramPoint> cell_in_triangle(const FlatRing& ring, int t, AreaForm form);
/// Returns the polygon of the vertex's cell in all triangles of the ring, without the vertex itself.
std::vector<report::DiagramPoint> cell_of(const FlatRing& ring, AreaForm form);
/// True if triangle t has an obtuse angle, at any of its corners.
bool is_obtuse(const FlatRing& ring, int t);

/// Returns the smallest angle of the triangles around a vertex, at any corner [rad].
double smallest_angle_around(const TriangleMesh& mesh, const MeshTopology& topology, int vertex);

/// Computes the tangential share of the uniform Δx, which is no curvature: 1 − (Δx · n)²/‖Δx‖², n the area-weighted vertex normal.
/// @return n values from 0 to 1; 0 where Δx is rounding; NaN on the boundary and where the mesh is not manifold
Vector tangential_shares(const TriangleMesh& mesh, const MeshTopology& topology);

/// A mesh and the vertex with the ring that a diagram draws.
struct SampleRing {
    TriangleMesh mesh;
    MeshTopology topology;
    int vertex = 0;
};
/// Returns an icosahedron with vertices moved along the sphere, and its ring with the largest tangential share of Δx.
SampleRing ring_on_a_sphere();
/// Returns a flat equilateral mesh with vertices moved within the plane, and its most obtuse ring with a single obtuse triangle.
SampleRing obtuse_ring_in_a_plane();
/// Returns the mesh of obtuse_ring_in_a_plane(), and its ring without obtuse triangles that has the mean of its corners farthest from the
/// vertex, in mean edges of the ring.
SampleRing uneven_ring_in_a_plane();

}   // namespace meshfolio
