/// @file
/// Vertices joined by edges without length. They are one point of the surface, and so one degree of freedom of every operator: one row of
/// C and M, one motion, one value of a mode. Every operator is assembled on the mesh in which they are joined (LaplaceBeltrami::copies).
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// A vertex that is the same point as an earlier one.
struct VertexCopy {
    int vertex;
    int of;   // the first vertex of the class, itself no copy

    bool operator==(const VertexCopy&) const = default;
};

/// The largest δ, of the longest edge of one of its triangles, that an edge without length may have. The weight of an edge of length δ is
/// 1/δ times the others and drowns them in rounding ε/δ; to join its ends is an error of δ. The two are alike at √ε, so that results tend
/// to those of coincident vertices as the gap closes.
inline const double no_length = std::sqrt(std::numeric_limits<double>::epsilon());
/// Flips to Delaunay may leave one end a triangle of area δ² alone, and so an eigenvalue of 1/δ²: alike at ε^⅓.
inline const double no_length_to_flips = std::cbrt(std::numeric_limits<double>::epsilon());

/// Vertices joined by edges of length `no_length` or less. In a triangle without area, which gives no stiffness to hold its ends together,
/// an edge of √no_area = 1e-6 has none either.
/// @return  all vertices but the first of each class, ascending; empty for almost every mesh, and where no triangle would be left
std::vector<VertexCopy> coincident_vertices(const TriangleMesh& mesh, double longest = no_length);

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

/// compute(mesh, topology), n values, of the mesh with these vertices joined, spread to all vertices.
template <class Compute>
Vector on_joined_vertices(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<VertexCopy>& copies, Compute compute) {
    if (copies.empty()) return compute(mesh, topology);
    const TriangleMesh joined = with_joined_vertices(mesh, copies);
    Vector values = compute(joined, topology_of(joined));
    spread(copies, values);
    return values;
}

}   // namespace meshfolio
