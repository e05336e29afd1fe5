/// @file
/// Pictures in memory: 8-bit sRGB with straight alpha, rows from the top.
#pragma once

#include <cstdint>

#include "scene/large_array.h"

namespace render {

struct Rgba {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
    friend bool operator==(const Rgba&, const Rgba&) = default;
};

struct Image {
    int width = 0, height = 0;
    LargeArray<Rgba> pixels;   // width × height

    Image() = default;
    Image(int w, int h, Rgba fill = {255, 255, 255, 255});

    Rgba& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
    const Rgba& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

/// Composites `source` over `target` with its upper left corner at (x, y), cut off at the edges of `target`.
void paste(Image& target, const Image& source, int x, int y);

/// Returns the picture at a smaller size, by area averaging in linear light. @throws std::invalid_argument if a side is below 1 or larger
/// than that of `image`
Image shrink(const Image& image, int width, int height);

}   // namespace render
