/// @file
/// Columns that files hold as one array.
#pragma once

#include <span>
#include <vector>

#include "mesh/io/scalar_type.h"

namespace meshfolio {

using ColumnGroup = std::span<const VertexColumn>;

/// Neighbours of one type make a group: the columns of an array; red, green, blue and perhaps alpha; nx, ny, nz. Others stand alone.
std::vector<ColumnGroup> groups_of(const std::vector<VertexColumn>& columns);

/// Does glTF hold it as a colour (COLOR_0): integers of 8 or 16 bits, or floats between 0 and 1 (undefined ones are white)?
bool is_gltf_color(ColumnGroup group);

}   // namespace meshfolio
