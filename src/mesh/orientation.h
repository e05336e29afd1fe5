/// @file
/// One orientation for each piece of a surface, on which the sign of mean curvature depends.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_topology.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Orientation {
    std::vector<char> flip;          // m flags: turn this triangle
    int disagreeing_faces = 0;       // turned to agree with the majority of their piece
    int first_disagreeing = -1;      // the first of them
    int inside_out_components = 0;   // shells of bodies, turned as a whole because they pointed inwards
    int first_inside_out = -1;       // a triangle of the first of them
    int filled_cavities = 0;         // shells of cavities, turned as a whole because they pointed outwards
    int first_filled_cavity = -1;
    int shells_of_unknown_depth = 0;   // left as they are (nesting.h)
    int unorientable_components = 0;   // left as they are: Möbius strips and the like
    int first_unorientable = -1;
};

/// Returns the triangles to turn. Afterwards all triangles of a piece agree with its majority, and normals of closed pieces point out of
/// bodies and into cavities, by their nesting depth (nesting.h). Pieces are joined through edges of exactly two triangles. Pieces that
/// share other edges and are closed together are turned together. Every triangle must name three different vertices.
Orientation consistent_orientation(const TriangleMesh& mesh);
/// Returns consistent_orientation(mesh) from a known topology, in a fraction of the time for an oriented manifold.
Orientation consistent_orientation(const TriangleMesh& mesh, const MeshTopology& topology);

/// Returns, for each component, the number of edges that its triangles do not run through as often one way as the other. A component with
/// none is the oriented boundary of a solid: ⅓ Σ x · n dA is ∫ w dx, w the winding number, for any origin (Jacobson et al. 2013).
std::vector<int> edges_out_of_balance_by_component(const TriangleMesh& mesh, const MeshTopology& topology);
/// Returns the number of edges of the mesh that its triangles do not run through as often one way as the other.
int edges_out_of_balance(const TriangleMesh& mesh, const MeshTopology& topology);

/// True if there are triangles, and they run through every edge as often one way as the other, so that the mesh has a volume.
bool encloses_volume(const TriangleMesh& mesh, const MeshTopology& topology);
/// Returns the reason why the mesh encloses no volume, as in "the surface is open: …"; empty if it encloses one.
std::string why_no_volume(const TriangleMesh& mesh, const MeshTopology& topology);
/// Returns signed_volume() of a mesh that encloses a volume, NaN for others. [length³]
double enclosed_volume(const TriangleMesh& mesh, const MeshTopology& topology);
double enclosed_volume(const TriangleMesh& mesh);

}   // namespace meshfolio
