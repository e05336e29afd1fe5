/// @file
/// 8-bit sRGB to linear light and back (IEC 61966-2-1). Averages of colours are taken in linear light.
#pragma once

#include <cstdint>

#include "image.h"

namespace render {

/// Linear light with the colour multiplied by its alpha, so that sums and averages are right.
struct LinearColor {
    float r = 0, g = 0, b = 0, a = 0;

    LinearColor& operator+=(const LinearColor& c) {
        r += c.r, g += c.g, b += c.b, a += c.a;
        return *this;
    }
    friend LinearColor operator*(float s, const LinearColor& c) { return {s * c.r, s * c.g, s * c.b, s * c.a}; }
};

/// Linear light in [0, 1] of an 8-bit sRGB channel.
float linear_of(std::uint8_t channel);
/// The nearest 8-bit sRGB channel, clamped; srgb_of(linear_of(c)) == c.
std::uint8_t srgb_of(float linear);

LinearColor linear_of(Rgba color);
Rgba srgb_of(const LinearColor& color);

}   // namespace render
