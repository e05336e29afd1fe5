/// @file
/// What kind of surface a mesh is, by the angles between its faces.
#pragma once

#include <string_view>
#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

inline constexpr double feature_angle = 40;   // two faces that meet at more make a feature edge [°]

/// n flags: vertices of feature edges.
std::vector<char> feature_vertices(const TriangleMesh& mesh, const MeshTopology& topology);

/// Means of n values where a flag is set, and elsewhere; NaN over no vertex.
struct FlaggedMeans {
    double there, elsewhere;
    int count, others;   // vertices
};
FlaggedMeans flagged_means(const Vector& values, const std::vector<char>& flags);

/// The vertex of the sharpest edge (the first of equals), or the first in use where no two faces meet.
int sharpest_vertex(const TriangleMesh& mesh, const MeshTopology& topology);

enum class MeshClass { flat, smooth, sharp_edged, rough };
std::string_view title_of(MeshClass kind);

struct MeshCharacter {
    double feature_share = 0;   // of the vertices, those of feature edges
    double typical_angle = 0;   // median angle between faces at the other edges [°]
    double largest_angle = 0;   // at any edge [°]
    bool open = false;          // has a boundary

    /// flat: all angles < 1°. smooth: less than 1 % of the vertices on feature edges. sharp-edged: more, but the typical angle at other
    /// edges is < 10°. rough: the others, by noise or by coarse triangles.
    MeshClass kind() const;
};
MeshCharacter mesh_character(const TriangleMesh& mesh, const MeshTopology& topology);

/// Median angle between the faces at all inner edges: one set of edges, whatever smoothing makes of them [°].
double median_face_angle(const TriangleMesh& mesh, const MeshTopology& topology);

/// Mean angle between the faces at the inner edges of each vertex; NaN where it has none [n, °].
Vector vertex_face_angles(const TriangleMesh& mesh, const MeshTopology& topology);

}   // namespace meshfolio
