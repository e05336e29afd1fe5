/// @file
/// From sums in linear light to pixels.
#pragma once

#include <cstdint>
#include <span>

#include "color/srgb.h"

namespace render {

/// pixels[i] = surfaces[i] over `background`, in 8-bit sRGB.
void resolve(std::span<const LinearColor> surfaces, Rgba background, std::span<Rgba> pixels);

/// Linear light times coverage, in 1/65535: what is kept of a pixel until its occlusion and lines are known.
struct Layer {
    std::uint16_t r = 0, g = 0, b = 0, coverage = 0;
};
void pack(std::span<const LinearColor> surfaces, std::span<Layer> layers);
/// All three of one length. surfaces[i] = layers[i] with its light times light[i].
void unpack(std::span<const Layer> layers, std::span<const float> light, std::span<LinearColor> surfaces);

}   // namespace render
