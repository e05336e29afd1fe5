/// @file
/// The bytes of formats that hold columns, and an OBJ file written again. What they cannot hold is checked before (encode_mesh).
#pragma once

#include <string>
#include <vector>

#include "mesh/io/scalar_type.h"

namespace meshfolio {

/// Binary little endian, coordinates as double.
std::string ply_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns);

/// PolyData of VTK in XML, its arrays appended as they are, coordinates as double. Colours and normals are arrays of components.
std::string vtp_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns);

/// Binary glTF 2.0, coordinates as float in a frame that suits the mesh; components that touch are meshes of their own. Colours are
/// COLOR_0, in linear light; any other column or array c is the attribute _c, as float. It may hold no NaN and nothing infinite: 0 and the
/// largest floats stand for them.
std::string glb_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns);

/// A file of binary glTF 2.0: its JSON and its data, each filled up to a multiple of 4 bytes.
std::string glb_container(std::string json, std::string data);

/// Is the column a part of normals, which are no values: whoever writes them computes them anew?
inline bool is_normal(const VertexColumn& column) { return column.name == "nx" || column.name == "ny" || column.name == "nz"; }

/// The text of an OBJ file with the places of its vertices replaced. Texture coordinates, groups, materials, colours of vertices, lines,
/// points, comments and all else stay as they are, but for commands. A polygon stays one where it falls into the triangles of the mesh
/// again; else they are written with its corners. Normals are the means, by area, over the corners that shared both vertex and normal.
/// @param mesh  rows of X as the text has vertices; triangles of the text in its order, which may be turned or left out
std::string obj_with_positions(const Attributes& of, const TriangleMesh& mesh);

}   // namespace meshfolio
