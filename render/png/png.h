/// @file
/// Pictures to bytes and back. PNG by a Paeth filter and a coder of our own, RGB when the picture is opaque; JPEG by
/// stb_image_write; PNG is read by stb_image.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scene/image.h"

namespace render {

/// Pixels of a PNG: their bytes, however badly they compress, fit one chunk of 2 GB.
inline constexpr std::int64_t largest_png = 480'000'000;

/// @throws std::invalid_argument for an empty picture or one of more than `largest_png` pixels (JPEG: 268 million)
std::string encode_png(const Image& image);
/// Composited on white. quality 1–100; 4:4:4 from 91 up (stb).
std::string encode_jpeg(const Image& image, int quality);

/// What encode_png() wrote, or any other PNG of 8 bits a channel; nothing when it is none, damaged or larger than `largest` pixels.
std::optional<Image> decode_png(std::string_view png, std::int64_t largest = largest_png);

}   // namespace render
