/// @file
/// Where samples lie. Everything on the screen is counted in grid steps of 1/256 pixel, so that coverage is a question of integers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace render {

/// Grid steps per pixel.
inline constexpr int subpixels = 256;
inline constexpr int half_pixel = subpixels / 2;

/// Samples are kept in blocks of this many, whatever the number per pixel: 2 × 2 pixels of 4 samples or 4 × 4 pixels of 1. A block
/// is one cache line of depths, one of triangle numbers, and one vector of the widest instruction set.
inline constexpr int block_samples = 16;

/// A pattern of samples. Sample i of a block is sample i % per_pixel of its pixel i / per_pixel; pixels are numbered row by row.
struct SamplePattern {
    int per_pixel;
    int block_side;                                 // pixels
    int first, pitch;                               // columns and rows with samples: first + pitch · i
    std::array<std::int32_t, block_samples> x, y;   // from the upper left corner of the block
    std::array<std::int32_t, 2> columns_of_rows;    // of eight by eight lines, which repeat: bit 8 r + c where row r, column c has a sample

    constexpr int block_shift() const { return block_side == 2 ? 9 : 10; }   // log2 of its side in grid steps
    constexpr int pitch_shift() const { return pitch == 64 ? 6 : 8; }
};

/// The middle of every pixel.
inline constexpr SamplePattern one_sample = [] {
    SamplePattern p{1, 4, 128, 256, {}, {}, {-1, -1}};
    for (int i = 0; i < block_samples; ++i) {
        p.x[static_cast<std::size_t>(i)] = i % 4 * subpixels + 128;
        p.y[static_cast<std::size_t>(i)] = i / 4 * subpixels + 128;
    }
    return p;
}();

/// A rotated grid, in which no two samples of a pixel share a row or a column. Every other pixel, as on a chessboard, has its mirror
/// image: so the pattern of a picture of even size is its own mirror image, left to right and top to bottom.
inline constexpr SamplePattern four_samples = [] {
    constexpr std::array<int, 4> right_hand{96, 224, 32, 160};
    SamplePattern p{4, 2, 32, 64, {}, {}, {}};
    std::array<std::uint32_t, 2> columns{};
    for (int i = 0; i < block_samples; ++i) {
        const int pixel = i / 4, column = pixel % 2, row = pixel / 2, s = i % 4;
        const int across = right_hand[static_cast<std::size_t>(s)];
        p.x[static_cast<std::size_t>(i)] = column * subpixels + ((column + row) % 2 == 0 ? across : subpixels - across);
        p.y[static_cast<std::size_t>(i)] = row * subpixels + 32 + 64 * s;
        columns[static_cast<std::size_t>(row)] |= 1U << (8 * s + (p.x[static_cast<std::size_t>(i)] - 32) / 64);
    }
    for (std::size_t row = 0; row < 2; ++row) p.columns_of_rows[row] = static_cast<std::int32_t>(columns[row]);
    return p;
}();

/// @param samples  per pixel, 1 or 4
inline const SamplePattern& pattern_of(int samples) { return samples == 1 ? one_sample : four_samples; }

/// Pixels on the side of a tile: what one thread draws at a time, small enough for its cache (256 KiB at 4 samples).
inline constexpr int tile_side = 64;

}   // namespace render
