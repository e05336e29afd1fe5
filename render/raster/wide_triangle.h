/// @file
/// Triangles of any size, drawn exactly, one at a time.
#pragma once

#include "raster/rasterizer.h"

namespace render {

/// As `rasterize`, for corners up to `largest_coordinate`; others are left out.
void rasterize_wide(const Triangle2& triangle, std::int32_t id, SampleTile& tile);

}   // namespace render
