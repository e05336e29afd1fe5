#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/rasterizer.h"
#include "scene/scene.h"

namespace render {

/// Some thousand consecutive triangles, sorted by projection and tile.
struct TileListPart {
    std::vector<std::uint32_t> start;   // of the list of each (projection, tile) in `triangles`, and the end
    std::vector<std::int32_t> triangles;
};

/// Ascending lists of the triangles of every tile in every projection, without most of those that cover no sample. Memory: 4 bytes for each
/// tile that a triangle meets, at least 4 for each triangle.
class TileLists {
public:
    /// @throws TooMuchOverdraw if the lists exceed the budget
    TileLists(std::span<const ProjectedScene> projections, const SamplePattern& pattern, WideBudget& budget);

    int columns() const { return columns_; }   // of tiles
    int rows() const { return rows_; }
    /// Replaces `triangles` by the ascending list of the triangles of a tile in a projection. @param tile  row · columns() + column
    void collect(std::size_t projection, int tile, std::vector<std::int32_t>& triangles) const;

private:
    int columns_, rows_;
    std::vector<TileListPart> parts_;
};

}   // namespace render
