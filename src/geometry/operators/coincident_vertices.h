/// @file
/// Vertices joined by edges without length. They are one point of the surface, and so one degree of freedom of every operator: one row of
/// C and M, one motion, one value of a mode. Every operator is assembled on the mesh in which they are joined (LaplaceBeltrami::copies).
#pragma once

#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// A vertex that is the same point as an earlier one.
struct VertexCopy {
    int vertex;
    int of;   // the first vertex of the class, itself no copy

    bool operator==(const VertexCopy&) const = default;
};

/// An edge has no length if it is at most √ε = 1.5e-8 of the longest edge of one of its triangles, or at most √no_area = 1e-6 of it in a
/// triangle without area, which gives no stiffness to hold its ends together. The weight of an edge of relative length δ is 1/δ times the
/// others and drowns them in rounding ε/δ; to join its ends is an error of δ. The two are alike at √ε, so that results tend to those of
/// coincident vertices as the gap closes.
/// @return  all vertices but the first of each class, ascending; empty for almost every mesh
std::vector<VertexCopy> coincident_vertices(const TriangleMesh& mesh);

/// The mesh of the same vertices whose triangles name the first vertex of each class. Triangles that name a vertex twice then are left out.
TriangleMesh with_joined_vertices(const TriangleMesh& mesh, const std::vector<VertexCopy>& copies);

/// The rows of copies become those of the vertices they are copies of.
template <class Rows>
void spread(const std::vector<VertexCopy>& copies, Rows& all) {
    for (const VertexCopy& copy : copies) all.row(copy.vertex) = all.row(copy.of);
}

/// From masses at the first vertices of the classes to equal shares of all their members.
void share_equally(const std::vector<VertexCopy>& copies, Vector& masses);
/// And back: the sum over each class at its first vertex, 0 at the others.
Vector summed_at_first(const std::vector<VertexCopy>& copies, Vector masses);

/// compute(mesh, topology, copies), n values, of the mesh with coincident vertices joined, spread to all vertices.
template <class Compute>
Vector on_joined_vertices(const TriangleMesh& mesh, const MeshTopology& topology, Compute compute) {
    const std::vector<VertexCopy> copies = coincident_vertices(mesh);
    if (copies.empty()) return compute(mesh, topology, copies);
    const TriangleMesh joined = with_joined_vertices(mesh, copies);
    Vector values = compute(joined, topology_of(joined), copies);
    spread(copies, values);
    return values;
}

}   // namespace meshfolio
