/// @file
/// Which triangles each tile of a picture has to draw.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/rasterizer.h"
#include "scene/scene.h"

namespace render {

/// The triangles of every tile of every projection, ascending; most of those that cover no sample are left out. Memory: 4 bytes for each
/// tile that a triangle meets, or one.
class TileLists {
public:
    /// @throws TooMuchOverdraw when the budget does not hold the entries
    TileLists(std::span<const ProjectedScene> projections, const SamplePattern& pattern, WideBudget& budget);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    /// Copies the list of a tile into `triangles`. @param tile  row · columns() + column
    void collect(std::size_t projection, int tile, std::vector<std::int32_t>& triangles) const;

private:
    /// Some thousand triangles in succession, sorted by projection and tile.
    struct Part {
        std::vector<std::uint32_t> start;   // of each (projection, tile) in `triangles`, and the end
        std::vector<std::int32_t> triangles;
    };

    int columns_, rows_;
    std::vector<Part> parts_;

    friend class PartSorter;
};

}   // namespace render
