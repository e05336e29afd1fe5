/// @file
/// One orientation for each piece of a surface: the sign of mean curvature hangs on it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/mesh_topology.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Orientation {
    std::vector<char> flip;          // m flags: turn this triangle
    int disagreeing_faces = 0;       // turned to agree with the majority of their piece
    int first_disagreeing = -1;      // the first of them
    int inside_out_components = 0;   // shells of bodies, turned as a whole because their volume was negative
    int first_inside_out = -1;       // a triangle of the first of them
    int filled_cavities = 0;         // shells at an odd nesting depth, turned because their volume was positive
    int first_filled_cavity = -1;
    int shells_of_unknown_depth = 0;   // left as they are (nesting.h)
    int unorientable_components = 0;   // left as they are: Möbius strips and the like
    int first_unorientable = -1;
};

/// Pieces are joined through edges of exactly two triangles. Within a piece all agree with the majority. Closed pieces, and sets of pieces
/// that share edges and are closed together, are turned by their nesting depth (nesting.h): normals point out of the bodies, into the
/// cavities. A surface that points so is left alone. Every triangle must name three different vertices.
Orientation consistent_orientation(const TriangleMesh& mesh);
/// The same where the topology is known, which takes a fraction of the time when it is that of an oriented manifold.
/// @param also  called for blocks (begin, end) of all triangles, by several threads; often while their corners are in the cache
Orientation consistent_orientation(const TriangleMesh& mesh, const MeshTopology& topology, const std::function<void(int, int)>& also);

/// c counts: edges of each component that its triangles do not run through as often one way as the other. A component without any is the
/// oriented boundary of a solid: wherever the origin lies, ⅓ Σ x · n dA is ∫ w dx, w the winding number (Jacobson et al. 2013).
std::vector<int> edges_out_of_balance_by_component(const TriangleMesh& mesh, const MeshTopology& topology);
/// Of all components.
int edges_out_of_balance(const TriangleMesh& mesh, const MeshTopology& topology);

/// Whether all edges are in balance, so that the mesh has a volume. False without triangles.
bool encloses_volume(const TriangleMesh& mesh, const MeshTopology& topology);
/// In words, why it encloses none; empty where it does.
std::string why_no_volume(const TriangleMesh& mesh, const MeshTopology& topology);
/// signed_volume() of a mesh that encloses a volume, NaN for others. [length³]
double enclosed_volume(const TriangleMesh& mesh, const MeshTopology& topology);
double enclosed_volume(const TriangleMesh& mesh);

}   // namespace meshfolio
