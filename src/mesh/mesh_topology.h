/// @file
/// Who touches whom. Built once from the faces; rows are sorted, so nothing depends on hash order.
#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Lists of integers of different lengths, one after the other (compressed rows).
struct Incidence {
    std::vector<int> start;   // size rows + 1
    std::vector<int> item;
    int size(int row) const { return start[static_cast<std::size_t>(row) + 1] - start[static_cast<std::size_t>(row)]; }
    const int* begin(int row) const { return item.data() + start[static_cast<std::size_t>(row)]; }
    const int* end(int row) const { return item.data() + start[static_cast<std::size_t>(row) + 1]; }
};

struct Edge {
    int a, b;    // a < b
    int faces;   // how many triangles share it: 1 boundary, 2 manifold, more non-manifold
};

struct MeshTopology {
    std::vector<Edge> edges;         // sorted by (a, b)
    Incidence vertex_faces;          // row v: triangles around v, ascending
    Incidence neighbours;            // row v: one-ring, ascending
    std::vector<char> on_boundary;   // n flags: v is an end of an edge with one triangle
    std::vector<char> nonmanifold;   // n flags: v touches a non-manifold edge, or its triangles form more than one fan
    std::vector<int> component;      // m labels from 0, in order of first triangle; triangles are joined by shared vertices
    int component_count = 0;
    /// Around each vertex lies one fan of different triangles that run round it the same way: a manifold, with or without boundary, in
    /// which all triangles agree and none is there twice.
    bool oriented_manifold = false;

    int boundary_edge_count() const;
    int nonmanifold_edge_count() const;
    int nonmanifold_vertex_count() const;
};

/// Row v: triangles around v, ascending; a triangle that names v twice stands there twice.
Incidence triangles_around(const TriangleMesh& mesh);

/// Just the edges, sorted by (a, b). Where a triangle names a vertex twice its edges are counted twice.
std::vector<Edge> edges_of(const TriangleMesh& mesh);

/// @throws MeshError if a triangle names a vertex twice or one that does not exist
MeshTopology topology_of(const TriangleMesh& mesh);
/// The same but for `edges` and `neighbours`, which take as long as all the rest and are filled by `with_edges`. Every triangle must name
/// three different vertices that exist.
MeshTopology topology_without_edges(const TriangleMesh& mesh);
MeshTopology with_edges(MeshTopology topology, const TriangleMesh& mesh);

/// Boundary loops: vertices in order, the surface to their left, each loop starting at its smallest index. A vertex where
/// several loops touch belongs to each. Where non-manifold edges break the boundary up, its open pieces count as loops.
std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh);
/// The same where the edges are known.
std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh, const std::vector<Edge>& edges);

}   // namespace meshfolio
