#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "raster/rasterizer.h"

namespace render {

/// The fragments of one row of blocks, with one column for each property, so that shading handles a vector of them at a time. A fragment
/// stands for the samples of one pixel that see the same triangle. It is shaded at their middle, which lies in the triangle, by convexity.
struct alignas(64) Fragments {
    static constexpr std::size_t largest_count = std::size_t{tile_side} * block_samples;
    template <class T> using Column = std::array<T, largest_count + block_samples>;   // vectors may write beyond the last fragment

    Column<std::int32_t> triangle;
    Column<std::int32_t> pixel;   // within the row of blocks: row · tile_side + column
    Column<float> x, y;           // grid steps from the middle of the picture, y up
    Column<float> weight;         // share of the samples of the pixel

    // Set by shading, first the interpolated properties (along the axes of the projection):
    Column<float> normal_x, normal_y, normal_z;   // towards the viewer, not normalised
    Column<float> map_position;
    Column<float> back;          // 1 if the back is seen
    Column<float> ink;           // of edges and isolines, 0 to 1
    Column<float> fixed_light;   // replaces the light on the normal if > 0
    // then the colour in linear light:
    Column<float> red, green, blue;

    std::size_t count = 0;
};

/// Replaces the contents of `fragments` by the fragments of a row of blocks of the tile, without colours. Rows count from the top.
/// @param width, height  of the picture [pixels]
/// @param from_below  true: the triangles of smallest depth, which the opposite view sees; false: of largest depth
void collect_fragments(const SampleTile& tile, int block_row, int width, int height, bool from_below, Fragments& fragments);

/// Sets the heights of the visible surface above the picture plane, towards the viewer, for a row of blocks [pixels]: at the middle of a
/// pixel if its samples see one surface, for the surface with more samples on a silhouette, −∞ without a surface.
/// @param heights  of pixel row · tile_side + column
void collect_heights(const SampleTile& tile, int block_row, bool from_below, std::span<float, std::size_t{tile_side} * 4> heights);

}   // namespace render
