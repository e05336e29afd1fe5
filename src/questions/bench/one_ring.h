/// @file
/// The triangles around a vertex laid into a plane, as diagrams draw them and as angle deficits and areas are about.
#pragma once

#include <vector>

#include "geometry/operators/vertex_areas.h"
#include "mesh/mesh_topology.h"
#include "report/diagram.h"

namespace meshfolio {

/// Counter-clockwise neighbours of a vertex inside the surface, beginning with the smallest.
std::vector<int> ring_in_order(const TriangleMesh& mesh, const MeshTopology& topology, int vertex);

/// A one-ring, cut along its first edge and unfolded about the vertex at the origin. Lengths from it and angles at it are kept.
struct FlatRing {
    std::vector<report::DiagramPoint> corners;   // the neighbours; the first again at the end, turned by Σθ
    std::vector<double> angles;                  // θ of each triangle [rad]
    double gap() const;                          // 2π − Σθ

    int triangles() const { return static_cast<int>(angles.size()); }
};
/// @param start  direction of the first edge [rad]
FlatRing flat_ring(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, double start = 0);

/// The polygon of the vertex's cell in triangle t. Its signed area is the triangle's share of vertex_areas().
std::vector<report::DiagramPoint> cell_in_triangle(const FlatRing& ring, int t, AreaForm form);
/// The cell of all triangles.
std::vector<report::DiagramPoint> cell_of(const FlatRing& ring, AreaForm form);
/// Is triangle t obtuse at the vertex, or at the corner before or behind it?
bool is_obtuse(const FlatRing& ring, int t);

/// The smallest angle of the triangles around a vertex, at whatever corner [rad].
double smallest_angle_around(const TriangleMesh& mesh, const MeshTopology& topology, int vertex);

/// Share of the uniform Δx that lies along the surface and is no curvature: 1 − (Δx · n)²/‖Δx‖², n the area-weighted vertex normal.
/// @return n values from 0 to 1; 0 where Δx is rounding; NaN on the boundary and where the mesh is not manifold
Vector tangential_shares(const TriangleMesh& mesh, const MeshTopology& topology);

// Rings that diagrams draw, of meshes made for them.

struct SampleRing {
    TriangleMesh mesh;
    MeshTopology topology;
    int vertex = 0;
};
/// The ring with the largest tangential share of Δx on an icosahedron with vertices moved along the sphere.
SampleRing ring_on_a_sphere();
/// The most obtuse ring with one obtuse triangle, in a flat equilateral mesh with vertices moved within it.
SampleRing obtuse_ring_in_a_plane();
/// The ring of the same mesh without obtuse triangle whose mean is farthest from its vertex, in edges.
SampleRing uneven_ring_in_a_plane();

}   // namespace meshfolio
