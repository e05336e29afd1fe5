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

/// Returns the smallest axis-aligned box of the vertices that triangles use, or of all vertices if there are no triangles.
Box bounding_box(const TriangleMesh& mesh);

/// Returns m × 3 lengths; entry (t, k) is the edge opposite corner k. [length]
CornerValues edge_lengths(const TriangleMesh& mesh);
/// Returns the mean length of the distinct edges, 0 if there are none. [length]
double mean_edge_length(const TriangleMesh& mesh);
/// Returns the mean length of these edges, at least one. [length]
double mean_edge_length(const TriangleMesh& mesh, const std::vector<Edge>& edges);

/// Returns m × 3 interior angles by atan2(|u × v|, u · v), in [0, π]. The angles of a triangle without area sum to π or are all zero. [rad]
CornerValues corner_angles(const TriangleMesh& mesh);

/// Returns m areas ½|u × v|. [length²]
Vector face_areas(const TriangleMesh& mesh);
/// Returns the sum of the face areas. [length²]
double surface_area(const TriangleMesh& mesh);
/// Returns Σ x₀ · (x₁ × x₂) / 6 about the box centre: the volume in a closed mesh, positive if normals point out. [length³]
double signed_volume(const TriangleMesh& mesh);
/// Returns Σ (x₀ − c) · ((x₁ − c) × (x₂ − c)) / 6 about c = `centre`; equal for all centres in a closed mesh. [length³]
double signed_volume(const TriangleMesh& mesh, const Vector3& centre);

/// Returns six times the signed volume of the tetrahedron between triangle t and a point. [length³]
double six_volumes(const TriangleMesh& mesh, int t, const Vector3& point);

/// Returns m × 3 unit normals; (0, 0, 0) for a triangle without area.
Positions face_normals(const TriangleMesh& mesh);
/// Returns n × 3 unit normals, the normalised sums of the area vectors around each vertex; (0, 0, 0) for a sum of zero.
Positions vertex_normals(const TriangleMesh& mesh);

}   // namespace meshfolio
