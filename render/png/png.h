/// @file
/// PNG and JPEG. PNG is written by a Paeth filter and our own coder, as RGB if the picture is opaque, and read by stb_image; JPEG is
/// written by stb_image_write.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scene/image.h"

namespace render {

/// Largest number of pixels of a PNG: their bytes fit one chunk of 2 GB, however badly they compress.
inline constexpr std::int64_t largest_png = 480'000'000;

/// Returns the bytes of a PNG file: RGB if all pixels are opaque, else RGBA, 8 bits a channel.
/// @param pixels_per_inch  told to the reader of the file; 0: not told
/// @throws std::invalid_argument if the picture is empty or has more than `largest_png` pixels
std::string encode_png(const Image& image, double pixels_per_inch = 0);
/// Returns the bytes of a JPEG file of the picture, composited on white. @param quality  1 to 100; no chroma subsampling from 91 on (stb)
/// @throws std::invalid_argument if the picture is empty or has more than 268 million pixels, or the quality is out of range
std::string encode_jpeg(const Image& image, int quality);

/// Decodes the bytes of a PNG file to 8-bit RGBA. Returns nothing if they are damaged or the picture has more than `largest` pixels.
std::optional<Image> decode_png(std::string_view png, std::int64_t largest = largest_png);

}   // namespace render
