/// @file
/// Text in pictures: the sans of the pages (templates/fonts) through stb_truetype, embedded at build time. UTF-8.
#pragma once

#include <string>
#include <string_view>

#include "scene/image.h"

namespace render {

enum class Align { left, centre, right };
enum class Weight { regular, bold };

struct TextStyle {
    double size = 16;   // pixels from ascender to descender
    Rgba color{34, 34, 40, 255};
    Align align = Align::left;
    Weight weight = Weight::regular;
};

/// Width in pixels of `text` set in `style`.
double text_width(std::string_view text, const TextStyle& style);

/// Draws with the baseline at y; x is the left end, middle or right end by `style.align`.
void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style);

/// `text`, shortened with … so that it fits `width`.
std::string fit_text(std::string_view text, double width, const TextStyle& style);

}   // namespace render
