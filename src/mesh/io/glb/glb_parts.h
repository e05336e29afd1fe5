/// @file
/// How a mesh goes into a GLB: relative to which point and in which unit, so that floats hold it, and in how many parts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// The coordinates of a node: x = translation + scale · stored (glTF 2.0, §3.5.3).
struct GlbFrame {
    Vector3 translation = Vector3::Zero();
    double scale = 1;

    double stored(double x, int axis) const { return (x - translation[axis]) / scale; }
    /// A node with these; without them where they change nothing.
    nlohmann::ordered_json node(std::size_t mesh) const;
};

/// The frame in which floats hold the mesh best: none where they hold it exactly, or where it is near the origin for its size and of usual
/// size. Translation and scale are multiples and powers of 2, so that a mesh that was read is written the same again.
GlbFrame float_frame(const TriangleMesh& mesh);
/// The coordinates that a reader finds.
Positions stored_as_floats(const TriangleMesh& mesh, const GlbFrame& frame);

/// Of each vertex, in which of the file's meshes it is, from 0 in ascending order; −1 where no triangle uses it. Readers weld what a mesh
/// has at one place, so that components that touch go into different ones where their vertices do not lie mixed in the list.
/// @param X  as the file holds them
std::vector<int> parts_that_keep_apart(const TriangleMesh& mesh, const Positions& X);
/// How many vertices fewer a reader finds that welds within these parts.
int count_of_welded(const Positions& X, const std::vector<int>& parts);
/// Part 0 for every vertex of a triangle.
std::vector<int> one_part(const TriangleMesh& mesh);

}   // namespace meshfolio
