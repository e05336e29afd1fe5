/// @file
/// Conversion of sums in linear light to pixels.
#pragma once

#include <cstdint>
#include <span>

#include "color/srgb.h"

namespace render {

/// Sets pixels[i] to surfaces[i] over `background`, in 8-bit sRGB.
void resolve(std::span<const LinearColor> surfaces, Rgba background, std::span<Rgba> pixels);

/// A pixel until its occlusion and lines are known: linear light times coverage, in 1/65535.
struct Layer {
    std::uint16_t r = 0, g = 0, b = 0, coverage = 0;
};
/// Sets layers[i] to surfaces[i], each number clamped to 1 and rounded to 1/65535.
void pack(std::span<const LinearColor> surfaces, std::span<Layer> layers);
/// Sets surfaces[i] to layers[i] with its light multiplied by light[i]; all three have one length.
void unpack(std::span<const Layer> layers, std::span<const float> light, std::span<LinearColor> surfaces);

}   // namespace render
