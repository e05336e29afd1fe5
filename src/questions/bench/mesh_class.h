/// @file
/// The kind of surface of a mesh, from the angles between its faces.
#pragma once

#include <string_view>
#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

inline constexpr double feature_angle = 40;   // two faces that meet at a larger one make a feature edge [°]

/// Returns n flags: 1 for ends of edges where two faces meet at more than feature_angle; boundary edges never count.
std::vector<char> feature_vertices(const TriangleMesh& mesh, const MeshTopology& topology);

/// Means of n values over the vertices with a flag and over the others; NaN over no vertex.
struct FlaggedMeans {
    double there, elsewhere;
    int count, others;   // vertices with and without a flag
};
/// Computes the means. @param flags  n flags, not 0 for the vertices of `there`
FlaggedMeans flagged_means(const Vector& values, const std::vector<char>& flags);

/// Returns an end of the edge where two faces meet at the largest angle, the first of equals; the first corner of triangle 0 if no edge has
/// an angle.
int sharpest_vertex(const TriangleMesh& mesh, const MeshTopology& topology);

enum class MeshClass { flat, smooth, sharp_edged, rough };
std::string_view title_of(MeshClass kind);   // "flat", "smooth", "sharp-edged", "rough or coarse"

struct MeshCharacter {
    double feature_share = 0;   // of the vertices, those of feature edges
    double typical_angle = 0;   // median angle between faces at the other edges [°]
    double largest_angle = 0;   // at any edge [°]
    bool open = false;          // has a boundary

    /// Returns flat if all angles are below 1°, smooth if less than 1 % of the vertices are on feature edges, sharp-edged if the typical
    /// angle at the other edges is below 10°, else rough (noise or coarse triangles).
    MeshClass kind() const;
};
/// Measures the angles between the faces of the mesh, and the share of the vertices on feature edges.
MeshCharacter mesh_character(const TriangleMesh& mesh, const MeshTopology& topology);

/// Computes the median angle between the faces at all inner edges, sharp or not; 0 without inner edges [°].
double median_face_angle(const TriangleMesh& mesh, const MeshTopology& topology);

/// Computes n values: the mean angle between the faces at the inner edges of each vertex; NaN where a vertex has none [°].
Vector vertex_face_angles(const TriangleMesh& mesh, const MeshTopology& topology);

}   // namespace meshfolio
