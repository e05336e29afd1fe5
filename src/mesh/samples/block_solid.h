/// @file
/// Surfaces of solids put together from blocks, before they are bent into shape. Feature edges of the shape are edges of the blocks, and so
/// are represented exactly however finely the blocks are divided.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// The number of cells of each block along each axis: {{{4}, {2, 3}, {5}}} is 1 × 2 × 1 blocks.
using BlockDivisions = std::array<std::vector<int>, 3>;

struct BlockSurface {
    Positions X;                             // block coordinates: block (i, j, k) fills [i, i+1] × [j, j+1] × [k, k+1]
    std::vector<std::array<int, 4>> quads;   // counter-clockwise seen from outside
    std::vector<std::array<int, 2>> cell;    // place of each quad within its side: cells along its first and second edge
};

/// Returns the quads between filled and empty blocks: a closed surface, manifold unless filled blocks touch along an edge or a corner only.
BlockSurface surface_of_blocks(const BlockDivisions& divisions, const std::function<bool(int i, int j, int k)>& filled);

/// Returns two triangles for each quad q, cut along its corners 0–2 if `first_diagonal(surface, q)`, else along 1–3. Vertices are those of
/// the surface.
TriangleMesh triangulated(const BlockSurface& surface, const std::function<bool(const BlockSurface&, int q)>& first_diagonal);

}   // namespace meshfolio
