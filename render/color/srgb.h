/// @file
/// Conversions of 8-bit sRGB to linear light (IEC 61966-2-1), for averages of colours, and to CIELAB, for colour maps; and back.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "scene/image.h"

namespace render {

/// A colour in linear light, multiplied by its alpha, so that sums and averages are right.
struct LinearColor {
    float r = 0, g = 0, b = 0, a = 0;

    LinearColor& operator+=(const LinearColor& c) {
        r += c.r, g += c.g, b += c.b, a += c.a;
        return *this;
    }
    friend LinearColor operator*(float s, const LinearColor& c) { return {s * c.r, s * c.g, s * c.b, s * c.a}; }
};

/// Tables from 8-bit sRGB channels to linear light, and back.
struct SrgbTables {
    static constexpr int steps = 16384;   // fine enough to tell neighbouring dark channels apart
    std::array<float, 256> linear;
    std::array<std::uint8_t, steps + 1 + 3> channel;   // at the middle of each step; padded for reading in words

    SrgbTables();
};

/// Returns the tables, which the first call makes.
inline const SrgbTables& srgb_tables() {
    static const SrgbTables tables;
    return tables;
}

/// Returns the linear light in [0, 1] of an 8-bit sRGB channel.
inline float linear_of(std::uint8_t channel) { return srgb_tables().linear[channel]; }

/// Returns the nearest 8-bit sRGB channel of linear light, clamped to [0, 1]; srgb_of(linear_of(c)) == c.
inline std::uint8_t srgb_of(float linear) {
    return srgb_tables().channel[static_cast<std::size_t>(std::clamp(linear, 0.0F, 1.0F) * SrgbTables::steps)];
}

/// Returns the colour in linear light: red, green and blue in [0, 1], multiplied by the alpha in [0, 1].
inline LinearColor linear_of(Rgba color) {
    const std::array<float, 256>& linear = srgb_tables().linear;
    if (color.a == 255) return {linear[color.r], linear[color.g], linear[color.b], 1};
    const float a = static_cast<float>(color.a) / 255;
    return {a * linear[color.r], a * linear[color.g], a * linear[color.b], a};
}

/// Returns the nearest 8-bit colour, divided by its alpha; (0, 0, 0, 0) for an alpha of 0 or below.
Rgba srgb_of(const LinearColor& color);

/// Returns (L*, a*, b*) of CIELAB (CIE 1976, white D65): lightness 0 to 100, green to red, blue to yellow. Equal steps look nearly equal.
/// Ignores the alpha.
glm::dvec3 lab_of(Rgba color);

/// Returns the colour of (L*, a*, b*), each channel clamped to sRGB; opaque.
Rgba rgba_of_lab(const glm::dvec3& lab);

}   // namespace render
