/// @file
/// What has to be shaded: for every pixel of a row of blocks each triangle that it sees, once.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "raster/rasterizer.h"

namespace render {

/// Fragments of one row of blocks, a column a property, so that shading takes a vector of them at a time. A fragment stands for the
/// samples of one pixel that see the same triangle and is shaded at their middle, which by convexity lies in it.
struct alignas(64) Fragments {
    static constexpr std::size_t largest_count = std::size_t{tile_side} * block_samples;
    template <class T>
    using Column = std::array<T, largest_count + block_samples>;   // vectors may write beyond the last fragment

    Column<std::int32_t> triangle;
    Column<std::int32_t> pixel;   // within the row of blocks: row · tile_side + column
    Column<float> x, y;           // grid steps from the middle of the picture, y up
    Column<float> weight;         // share of the samples of the pixel

    // Filled in by shading, first what is interpolated (axes of the projection):
    Column<float> normal_x, normal_y, normal_z;   // towards the viewer, not normalised
    Column<float> map_position;
    Column<float> back;          // 1 where the back is seen
    Column<float> ink;           // of edges and isolines, 0 to 1
    Column<float> fixed_light;   // instead of that of the normal, where > 0
    // and then the colour, linear light:
    Column<float> red, green, blue;

    std::size_t count = 0;
};

/// Collects the fragments of a row of blocks. @param width, height  of the picture
/// @param from_below  what the opposite view sees
void collect_fragments(const SampleTile& tile, int block_row, int width, int height, bool from_below, Fragments& fragments);

/// How high the visible surface lies above the picture plane, towards the viewer, in pixels: at the middle of a pixel where its samples see
/// one surface; on a silhouette the side with more samples decides; −∞ where there is none. @param heights  of the row of blocks:
/// row · tile_side + column
void collect_heights(const SampleTile& tile, int block_row, bool from_below, std::span<float, std::size_t{tile_side} * 4> heights);

}   // namespace render
