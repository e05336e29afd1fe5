/// @file
/// An OBJ file written again over other positions.
#pragma once

#include <string>

#include "mesh/io/scalar_type.h"

namespace meshfolio {

/// The text with the places of its vertices replaced. Texture coordinates, groups, materials, colours of vertices, lines, points, comments
/// and all else stay as they are, but for commands. A polygon stays one where it falls into the triangles of the mesh again; else they
/// are written with its corners. Normals are computed anew: the mean, by area, over the corners that shared both vertex and normal.
/// @param mesh  rows of X as the text has vertices; triangles of the text in its order, which may be turned or left out
std::string obj_with_positions(const Attributes& of, const TriangleMesh& mesh);

}   // namespace meshfolio
