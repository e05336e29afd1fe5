/// @file
/// Differences of two meshes with the same triangles.
#pragma once

#include "geometry/linear/sparse_types.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

struct MeshDifference {
    double rms = 0;                         // √(Σ|a_i − b_i|²/n) over vertices [length]
    double max = 0;                         // largest |a_i − b_i| [length]
    double area_weighted_rms = 0;           // √(Σ A_i|a_i − b_i|²/ΣA_i), barycentric areas of `a` [length]
    double mean_normal_angle = 0;           // mean angle between corresponding face normals; NaN if none has an area in both [rad]
    double mean_squared_normal_angle = 0;   // NaN likewise [rad²]
    double volume_ratio = 0;                // V(b)/V(a); NaN when V(a) = 0 or they enclose none
    double area_ratio = 0;                  // A(b)/A(a)
    double box_diagonal = 0;                // of `a` [length]
    int inverted_faces = 0;                 // faces of b with a normal by more than 90° off that of a
};

/// Returns the differences of b from a, between corresponding vertices and triangles.
/// @throws MeshError if the numbers of vertices or the triangles differ
MeshDifference compare_meshes(const TriangleMesh& a, const TriangleMesh& b);

/// Returns √(Σ|a_i − b_i|²/n) over the n rows; 0 without rows. [length]
/// @throws MeshError if the sizes differ
double vertex_rms(const Positions& a, const Positions& b);

/// Returns n values, the distance of each row of X to the triangles around that vertex on the clean mesh (to the clean vertex if it has
/// none): 0 for motion within the surface, and near the distance to the surface while vertices stay near. [length]
/// @throws MeshError if the sizes differ
Vector shape_distances(const TriangleMesh& clean, const Positions& X);
/// Returns the root mean square of shape_distances(clean, X); 0 without vertices. [length]
double shape_rms(const TriangleMesh& clean, const Positions& X);

/// Returns the mean angle between the rows of a and b, unit normals, without rows of zeros, which have no direction. NaN if no row is left,
/// for example when a mesh has shrunk to a point. [rad]
double mean_normal_angle(const Positions& a, const Positions& b);

/// Returns the smallest interior angle of all triangles; NaN without triangles. [rad]
double smallest_angle(const TriangleMesh& mesh);

}   // namespace meshfolio
