/// @file
/// The layout of a mesh in a GLB: the origin and the unit with which floats hold it, and its parts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// The coordinates of a node: x = translation + scale · stored (glTF 2.0, §3.5.3).
struct GlbFrame {
    Vector3 translation = Vector3::Zero();
    double scale = 1;

    double stored(double x, int axis) const { return (x - translation[axis]) / scale; }
    /// Returns the JSON of a node with this frame. @param mesh  number of its mesh in the file
    nlohmann::ordered_json node(std::size_t mesh) const;
};

/// Returns the frame in which floats hold the mesh best: the identity if they hold it exactly, or if it has a usual size and is near the
/// origin. Translation and scale are multiples and powers of 2, so that a mesh that was read is written the same again.
GlbFrame float_frame(const TriangleMesh& mesh);
/// Returns the positions as a reader finds them: rounded to floats in the frame and mapped back.
Positions stored_as_floats(const TriangleMesh& mesh, const GlbFrame& frame);

/// Returns the part of each vertex, from 0 in ascending order; −1 for vertices that no triangle uses. Each part becomes a mesh of the file:
/// readers weld vertices of a mesh at one place, so components that touch are in different parts, unless their vertices are mixed in order.
/// @param X  stored_as_floats(mesh, frame)
std::vector<int> parts_that_keep_apart(const TriangleMesh& mesh, const Positions& X);
/// Returns the number of vertices that vanish when vertices with equal rows of X are welded within each part; part −1 does not count.
/// @param parts  of each vertex, ascending but for −1, as parts_that_keep_apart() returns them
int count_of_welded(const Positions& X, const std::vector<int>& parts);
/// Returns part 0 for every vertex of a triangle, −1 for the others.
std::vector<int> one_part(const TriangleMesh& mesh);

}   // namespace meshfolio
