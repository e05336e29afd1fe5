/// @file
/// The bytes of formats that hold columns. What they cannot hold is checked before (encode_mesh).
#pragma once

#include <string>
#include <vector>

#include "mesh/io/scalar_type.h"

namespace meshfolio {

/// Binary little endian, coordinates as double.
std::string ply_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns);

/// PolyData of VTK in XML, its arrays appended as they are, coordinates as double. Colours and normals are arrays of components.
std::string vtp_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns);

/// Binary glTF 2.0, coordinates as float. Colours are COLOR_0; any other column or array c is the attribute _c, as float. It
/// may hold no NaN and nothing infinite: 0 and the largest floats stand for them.
std::string glb_bytes(const TriangleMesh& mesh, const std::vector<VertexColumn>& columns);

}   // namespace meshfolio
