/// @file
/// Pictures to bytes. PNG by a Paeth filter and a coder of our own, RGB when the picture is opaque; JPEG by stb_image_write.
#pragma once

#include <string>

#include "image.h"

namespace render {

/// @throws std::invalid_argument for an empty picture or one of more than 480 million pixels (JPEG: 268 million)
std::string encode_png(const Image& image);
/// Composited on white. quality 1–100; 4:4:4 from 91 up (stb).
std::string encode_jpeg(const Image& image, int quality);

}   // namespace render
