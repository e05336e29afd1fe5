/// @file
/// UTF-8 text in pictures, in the sans-serif font of the pages (templates/fonts), which is embedded at build time; drawn by stb_truetype.
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

/// Returns the width of a text [pixels].
double text_width(std::string_view text, const TextStyle& style);

/// Draws a text with its baseline at y; x is its left end, middle or right end, as `style.align` says.
void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style);

/// Returns the text, shortened with "…" if it is wider than `width` pixels; "" if not even one character fits.
std::string fit_text(std::string_view text, double width, const TextStyle& style);

}   // namespace render
