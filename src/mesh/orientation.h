/// @file
/// One orientation for each piece of a surface: the sign of mean curvature hangs on it.
#pragma once

#include <functional>
#include <vector>

#include "mesh/mesh_topology.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Orientation {
    std::vector<char> flip;            // m flags: turn this triangle
    int disagreeing_faces = 0;         // turned to agree with the majority of their piece
    int first_disagreeing = -1;        // the first of them
    int inside_out_components = 0;     // closed pieces turned as a whole because their volume was negative
    int first_inside_out = -1;         // a triangle of the first of them
    int unorientable_components = 0;   // left as they are: Möbius strips and the like
    int first_unorientable = -1;
};

/// Pieces are joined through edges of exactly two triangles. Within a piece all agree with the majority; where it is closed, be it at edges
/// it shares with other pieces, normals point out of the volume it encloses. Every triangle must name three different vertices.
Orientation consistent_orientation(const TriangleMesh& mesh);
/// The same where the topology is known, which takes a fraction of the time when it is that of an oriented manifold.
/// @param also  called for blocks (begin, end) of all triangles, by several threads; often while their corners are in the cache
Orientation consistent_orientation(const TriangleMesh& mesh, const MeshTopology& topology, const std::function<void(int, int)>& also);

}   // namespace meshfolio
