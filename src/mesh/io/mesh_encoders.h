/// @file
/// Columns as files hold them, and writers of formats. What a format cannot hold is checked before, in encode_mesh.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/io/scalar_type.h"

namespace meshfolio {

/// True for nx, ny and nz: writers compute normals anew.
inline bool is_normal(const VertexColumn& column) { return column.name == "nx" || column.name == "ny" || column.name == "nz"; }

using ColumnGroup = std::span<const VertexColumn>;

/// Returns the columns in groups that files hold as one array: neighbours of one type that are the columns of an array; red, green, blue
/// and perhaps alpha; or nx, ny, nz. Others are alone in their group.
std::vector<ColumnGroup> groups_of(const std::vector<VertexColumn>& columns);

/// True if glTF holds the group as a colour (COLOR_0): integers of 8 or 16 bits, or floats between 0 and 1 (NaN becomes white).
bool is_gltf_color(ColumnGroup group);

/// Returns the mesh as binary glTF 2.0, coordinates as float in a frame that suits the mesh, components that touch as separate meshes. A
/// colour becomes COLOR_0, in linear light; any other column or array c the attribute _c, as float: 0 for NaN, ± the largest float for
/// numbers beyond.
std::string glb_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns);

/// Returns a file of binary glTF 2.0 from its JSON and its data, each filled up to a multiple of 4 bytes.
std::string glb_container(std::string json, std::string data);

/// Returns the text of an OBJ file with the positions of the mesh. All but normals stays as it is, except that commands are left out. Faces
/// become triangles, with their corners, unless the polygon would be triangulated in the same way again. Normals are the means, by area,
/// over the corners that shared both vertex and normal.
/// @param source  holds the text and its face lines
/// @param mesh    its rows of X are the vertices of the text; its triangles are those of the text, in order, but may be turned or left out
std::string obj_with_positions(const Attributes& source, const TriangleMesh& mesh);

}   // namespace meshfolio
