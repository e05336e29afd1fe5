/// @file
/// Edges, neighbours, components and boundaries of a mesh. Rows are sorted, so nothing depends on hash order.
#pragma once

#include <span>
#include <vector>

#include "base/at.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Lists of integers of different lengths, one after the other (compressed rows).
struct Incidence {
    std::vector<int> start;   // size rows + 1
    std::vector<int> item;
    int size(int row) const { return start[at(row) + 1] - start[at(row)]; }
    const int* begin(int row) const { return item.data() + start[at(row)]; }
    const int* end(int row) const { return item.data() + start[at(row) + 1]; }
};

/// Returns the integers i < row_of.size() as rows: row r lists those with row_of[i] = r, ascending. Entries −1 belong to no row.
Incidence grouped_by_row(int rows, std::span<const int> row_of);

struct Edge {
    int a, b;    // a < b
    int faces;   // triangles that share it: 1 boundary, 2 manifold, more non-manifold
};

struct MeshTopology {
    std::vector<Edge> edges;         // sorted by (a, b)
    Incidence vertex_faces;          // row v: triangles around v, ascending
    Incidence neighbours;            // row v: one-ring, ascending
    std::vector<char> on_boundary;   // n flags: v is an end of an edge with one triangle
    std::vector<char> nonmanifold;   // n flags: v touches a non-manifold edge, or its triangles form more than one fan
    std::vector<int> component;      // m labels from 0, in order of first triangle; triangles are joined by shared vertices
    int component_count = 0;
    bool oriented_manifold = false;   // every vertex is regular (VertexFan): a manifold, with or without boundary, oriented consistently

    int boundary_edge_count() const;
    int nonmanifold_edge_count() const;
    int nonmanifold_vertex_count() const;
};

/// Returns a row for each vertex v: the triangles around v, ascending; a triangle that names v twice is listed twice.
Incidence triangles_around(const TriangleMesh& mesh);

/// The triangles around one vertex.
struct VertexFan {
    bool on_boundary = false;   // an edge at the vertex has one triangle
    bool nonmanifold = false;   // an edge at the vertex has more than two, or the triangles form more than one fan
    bool regular = true;        // one fan (or none) of different triangles that all run round the vertex the same way
};
/// Returns the fan of vertex v. @param vertex_faces  triangles_around(mesh)
VertexFan fan_around(const TriangleMesh& mesh, const Incidence& vertex_faces, int v);

/// Returns the edges, sorted by (a, b). A triangle (a, a, b) adds 2 to `faces` of the edge (a, b).
std::vector<Edge> edges_of(const TriangleMesh& mesh);

/// Returns the topology of the mesh, with all its members. @throws MeshError if a triangle names a vertex twice or one that does not exist
MeshTopology topology_of(const TriangleMesh& mesh);
/// Returns the topology with empty `edges` and `neighbours`, in half the time. Triangles must name three different, existing vertices.
MeshTopology topology_without_edges(const TriangleMesh& mesh);
/// Returns `topology` with `edges` and `neighbours` filled. @param topology  topology_without_edges(mesh)
MeshTopology with_edges(MeshTopology topology, const TriangleMesh& mesh);

/// Returns the boundary loops: vertices in order, the surface to their left, each loop from its smallest index. A vertex at which
/// several loops touch belongs to each. If non-manifold edges break the boundary up, its open pieces count as loops.
std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh);
/// Returns the boundary loops, as boundary_loops(mesh), from known edges. @param edges  edges_of(mesh)
std::vector<std::vector<int>> boundary_loops(const TriangleMesh& mesh, const std::vector<Edge>& edges);

}   // namespace meshfolio
