/// @file
/// Places of samples. Everything on the screen is counted in grid steps of 1/256 pixel, so that coverage is decided in integers.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace render {

/// Grid steps per pixel.
inline constexpr int subpixels = 256;
inline constexpr int half_pixel = subpixels / 2;

/// Samples in a block: those of 1 pixel with 16, 2 × 2 pixels with 4 or 4 × 4 pixels with 1. Their depths, or triangle numbers, are one
/// cache line and one vector of the widest instruction set.
inline constexpr int block_samples = 16;

/// A pattern of samples. Sample i of a block is sample i % per_pixel of its pixel i / per_pixel; pixels are numbered row by row.
struct SamplePattern {
    int per_pixel;
    int block_side;                                 // pixels
    int first, pitch;                               // columns and rows with samples: first + pitch · i
    std::array<std::int32_t, block_samples> x, y;   // from the upper left corner of the block
    std::array<std::int32_t, 2> columns_of_rows;    // of 8 × 8 lines, which repeat: bit 8 r + c is set if row r, column c has a sample

    constexpr int block_shift() const { return std::bit_width(static_cast<unsigned>(block_side)) + 7; }   // log2 of its side in grid steps
    constexpr int pitch_shift() const { return std::bit_width(static_cast<unsigned>(pitch)) - 1; }
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

/// A rotated grid: no two samples of a pixel share a row or a column. Every other pixel, as on a chessboard, has the mirrored pattern, so
/// that the pattern of a picture of even size is symmetric left to right and top to bottom.
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

/// A rotated grid in each quarter of the pixel, mirrored from quarter to quarter.
inline constexpr SamplePattern sixteen_samples = [] {
    constexpr std::array<int, 4> row_of_column{1, 3, 0, 2};
    SamplePattern p{16, 1, 16, 32, {}, {}, {}};
    std::array<std::uint32_t, 2> columns{};
    for (int i = 0; i < block_samples; ++i) {
        const int c = i % 4, r = row_of_column[static_cast<std::size_t>(c)];
        const int column = i / 4 % 2 == 0 ? c : 7 - c, row = i / 8 == 0 ? r : 7 - r;
        p.x[static_cast<std::size_t>(i)] = 16 + 32 * column, p.y[static_cast<std::size_t>(i)] = 16 + 32 * row;
        columns[static_cast<std::size_t>(row / 4)] |= 1U << (8 * (row % 4) + column);
    }
    for (std::size_t half = 0; half < 2; ++half) p.columns_of_rows[half] = static_cast<std::int32_t>(columns[half]);
    return p;
}();

/// Returns the pattern for 1, 4 or 16 samples per pixel.
inline const SamplePattern& pattern_of(int samples) { return samples == 1 ? one_sample : samples == 4 ? four_samples : sixteen_samples; }

/// Pixels on the side of a tile, which one thread draws at a time: small enough for its cache (256 KiB at 4 samples, 1 MiB at 16).
inline constexpr int tile_side = 64;

}   // namespace render
