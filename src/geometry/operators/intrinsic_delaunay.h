/// @file
/// A surface as flat triangles glued side to side, given by edge lengths alone (Sharp, Soliman & Crane 2019), and its intrinsic Delaunay
/// triangulation (Bobenko & Springborn 2007): the same surface with straight edges drawn over it so that the two angles opposite an edge
/// never sum to more than π. Cotangent weights are ≥ 0 at its interior edges.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Triangles may be glued to themselves, and several edges may join the same two vertices. Side 3t + k of triangle t lies opposite its
/// corner k and runs from corner k + 1 to corner k + 2.
struct IntrinsicTriangles {
    static constexpr int not_glued = -1;

    Faces F;                     // m × 3 vertices
    CornerValues lengths;        // m × 3, of the side opposite each corner [length]
    std::vector<int> glued_to;   // 3m: the side at the other side of the edge, running the other way, or not_glued
    int vertex_count = 0;
};

/// Returns the triangles of a mesh, glued where exactly two run along an edge, in opposite directions. Boundaries, non-manifold edges and
/// edges with orientations that disagree stay open.
IntrinsicTriangles intrinsic_triangles(const TriangleMesh& mesh);

/// A side of a triangle, as a side of an edge.
struct SideOfEdge {
    int low, high;    // the ends, low ≤ high
    int side;         // 3t + k
    bool ascending;   // true if it runs from low to high
};
/// Calls visit(sides) for each pair of vertices that sides join, with all these sides in the order of the triangles.
void for_each_edge(const Faces& F, const std::function<void(std::span<const SideOfEdge>)>& visit);

/// Checks sizes and indices.
/// @throws MeshError naming `function` if `values` has not one row a face, or a face names a vertex outside [0, vertex_count)
void require_corner_values(const std::string& function, const Faces& F, int vertex_count, const CornerValues& values);

/// Checks edge lengths.
/// @throws MeshError naming `function` if a length is negative or not finite
void require_lengths(const std::string& function, const CornerValues& lengths);

struct IntrinsicDelaunay {
    IntrinsicTriangles triangles;
    int flips = 0;
};

/// Flips edges until all glued edges are Delaunay; edges that are not glued stay. Edges are taken in the order of their triangles. An edge
/// with opposite angles that sum to π within 1e-10 stays: flipping it would change nothing but rounding.
/// @throws SolverError if the flips do not end, as rounding can cause in triangles without area
IntrinsicDelaunay intrinsic_delaunay(IntrinsicTriangles triangles);

}   // namespace meshfolio
