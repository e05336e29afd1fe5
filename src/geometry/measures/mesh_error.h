/// @file
/// How far one mesh is from another with the same triangles, and how healthy it is.
#pragma once

#include "geometry/linear/sparse_types.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

struct MeshDifference {
    double rms = 0;                         // √(Σ|a_i − b_i|²/n) over vertices [length]
    double max = 0;                         // largest |a_i − b_i| [length]
    double area_weighted_rms = 0;           // √(Σ A_i|a_i − b_i|²/ΣA_i), barycentric areas of `a` [length]
    double mean_normal_angle = 0;           // mean angle between corresponding face normals; NaN where none has an area in both [rad]
    double mean_squared_normal_angle = 0;   // NaN likewise [rad²]
    double volume_ratio = 0;                // V(b)/V(a); NaN when V(a) = 0 or they enclose none
    double area_ratio = 0;                  // A(b)/A(a)
    double box_diagonal = 0;                // of `a`, to put lengths in relation [length]
    int inverted_faces = 0;                 // normal · original normal < 0
};

/// b measured against a.
/// @throws MeshError if the triangles differ
MeshDifference compare_meshes(const TriangleMesh& a, const TriangleMesh& b);

/// The cheap part, for error-versus-iteration curves. [length]
double vertex_rms(const Positions& a, const Positions& b);

/// Of each vertex of X the distance to the triangles that surround it on the clean mesh (to the clean vertex where there are none): 0 for
/// whatever moves vertices within the surface, and near the distance to the surface as long as they stay near. [length]
Vector shape_distances(const TriangleMesh& clean, const Positions& X);
/// Their root mean square. [length]
double shape_rms(const TriangleMesh& clean, const Positions& X);

/// Mean angle between the rows of a and b, unit normals; rows of zeros, which have no direction, are left out. NaN where no row is left,
/// as of a mesh that has shrunk to a point. [rad]
double mean_normal_angle(const Positions& a, const Positions& b);

/// Smallest interior angle of all triangles. [rad]
double smallest_angle(const TriangleMesh& mesh);

}   // namespace meshfolio
