/// @file
/// Lengths, angles, areas and normals of a triangle mesh. Units are powers of the model unit.
#pragma once

#include <vector>

#include "mesh/mesh_topology.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Box {
    Vector3 low, high;
    Vector3 extent() const { return high - low; }
    Vector3 centre() const { return low + 0.5 * (high - low); }
    double diagonal() const { return extent().norm(); }
};

/// Smallest axis-aligned box of the vertices that triangles use (of all vertices when there are no triangles).
Box bounding_box(const TriangleMesh& mesh);

/// m × 3 lengths; entry (t, k) is the edge opposite corner k. [length]
CornerValues edge_lengths(const TriangleMesh& mesh);
/// Mean length over the distinct edges. [length]
double mean_edge_length(const TriangleMesh& mesh);
double mean_edge_length(const TriangleMesh& mesh, const std::vector<Edge>& edges);

/// m × 3 interior angles by atan2(|u × v|, u · v), in [0, π]; a triangle of no area sums to π or is all zero. [rad]
CornerValues corner_angles(const TriangleMesh& mesh);

/// m areas ½|u × v|. [length²]
Vector face_areas(const TriangleMesh& mesh);
double surface_area(const TriangleMesh& mesh);
/// Σ x₀ · (x₁ × x₂) / 6 about the box centre: the enclosed volume of a closed mesh, positive when normals point out. [length³]
double signed_volume(const TriangleMesh& mesh);
/// The same about another point.
double signed_volume(const TriangleMesh& mesh, const Vector3& centre);

/// m × 3 unit normals; (0, 0, 0) where the area is zero.
Positions face_normals(const TriangleMesh& mesh);
/// n × 3 unit normals, area-weighted mean of the faces around; (0, 0, 0) at vertices without area.
Positions vertex_normals(const TriangleMesh& mesh);

}   // namespace meshfolio
