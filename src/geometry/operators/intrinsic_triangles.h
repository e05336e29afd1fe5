/// @file
/// A surface as flat triangles glued side to side, known by their edge lengths alone (Sharp, Soliman & Crane 2019). Triangles may
/// be glued to themselves, and several edges may join the same two vertices.
#pragma once

#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Side 3t + k of triangle t lies opposite its corner k and runs from corner k + 1 to corner k + 2.
struct IntrinsicTriangles {
    static constexpr int not_glued = -1;

    Faces F;                     // m × 3 vertices
    CornerValues lengths;        // m × 3, of the side opposite each corner [length]
    std::vector<int> glued_to;   // 3m: the side at the other side of the edge, running the other way, or not_glued
    int vertex_count = 0;
};

/// The triangles of a mesh, glued where an edge has exactly two that run along it in opposite directions. Boundaries, non-manifold
/// edges and edges where orientations disagree stay open.
IntrinsicTriangles intrinsic_triangles(const TriangleMesh& mesh);

struct SideOfEdge {
    int low, high;   // the ends, low <= high
    int side;
    bool ascending;   // runs from low to high
};
/// All 3m sides, sorted by edge, those of an edge in the order of the triangles.
std::vector<SideOfEdge> sides_by_edge(const Faces& F);

/// @throws MeshError naming `function` if `values` has not one row a face, or a face names a vertex outside [0, vertex_count)
void require_corner_values(const std::string& function, const Faces& F, int vertex_count, const CornerValues& values);

/// @throws MeshError naming `function` if a length is negative or not finite
void require_lengths(const std::string& function, const CornerValues& lengths);

}   // namespace meshfolio
