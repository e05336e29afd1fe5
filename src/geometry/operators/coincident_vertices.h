/// @file
/// Vertices joined by edges without length are one point of the surface, and so one degree of freedom of every operator: one row of C and
/// M, one motion, one value of a mode. Operators are assembled on the mesh in which they are joined (LaplaceBeltrami::copies).
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "mesh/mesh_topology.h"

namespace meshfolio {

/// A vertex at the same point as an earlier one.
struct VertexCopy {
    int vertex;
    int of;   // the first vertex of the class, itself no copy

    bool operator==(const VertexCopy&) const = default;
};

/// The largest length δ, relative to the longest edge of a triangle, that counts as none. The weight of an edge of length δ is 1/δ times
/// the others and drowns them in rounding ε/δ; joining its ends is an error of δ. The two are equal at √ε, so that results tend to those of
/// coincident vertices as the gap closes.
inline const double no_length = std::sqrt(std::numeric_limits<double>::epsilon());
/// The largest relative length that counts as none for Delaunay flips. They may leave one end a triangle of area δ² alone, and so an
/// eigenvalue of 1/δ²: the errors are equal at ε^⅓.
inline const double no_length_to_flips = std::cbrt(std::numeric_limits<double>::epsilon());

/// Finds the vertices joined by edges of relative length `longest` or less. In a triangle without area, which gives no stiffness to hold
/// its ends together, an edge of √no_area = 1e-6 counts, too.
/// @return  all vertices but the first of each class, ascending; empty for almost every mesh, and if no triangle would be left
std::vector<VertexCopy> coincident_vertices(const TriangleMesh& mesh, double longest = no_length);

/// Returns the mesh with the same vertices and with triangles between the first vertices of their classes, without collapsed triangles.
TriangleMesh with_joined_vertices(const TriangleMesh& mesh, const std::vector<VertexCopy>& copies);

/// Overwrites the row of each copy by the row of its first vertex.
template <class Rows> void spread(const std::vector<VertexCopy>& copies, Rows& all) {
    for (const VertexCopy& copy : copies) all.row(copy.vertex) = all.row(copy.of);
}

/// Divides the mass at the first vertex of each class equally among its members.
void share_equally(const std::vector<VertexCopy>& copies, Vector& masses);
/// Returns the masses summed over each class at its first vertex, 0 at the others.
Vector summed_at_first(const std::vector<VertexCopy>& copies, Vector masses);

/// Returns compute(mesh, topology), n values, for the mesh with the copies joined to their first vertices; copies get the value of their
/// first vertex.
template <class Compute>
Vector on_joined_vertices(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<VertexCopy>& copies, Compute compute) {
    if (copies.empty()) return compute(mesh, topology);
    const TriangleMesh joined = with_joined_vertices(mesh, copies);
    Vector values = compute(joined, topology_of(joined));
    spread(copies, values);
    return values;
}

}   // namespace meshfolio
