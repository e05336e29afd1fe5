/// @file
/// UTF-8 text in pictures, in the sans-serif font of the pages (templates/fonts), which is embedded at build time; drawn by stb_truetype.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

/// A glyph of a text, for vector files.
struct PlacedGlyph {
    int index;               // in the font file
    std::string_view text;   // its character in UTF-8; U+FFFD for a byte that is not UTF-8
    double place;            // of its origin, from the left end of its line [pixels]
    double advance;          // of the font; a combining mark moves nothing [pixels]
    double rise = 0;         // of a mark above a letter that is higher than x [pixels]
};
struct TextLine {
    std::vector<PlacedGlyph> glyphs;
    double width = 0;   // [pixels]
    double left = 0;    // of its left end, from the place that style.align says [pixels]
    double em = 0;      // size of the font [pixels]
};
/// Returns the glyphs of a text, which must outlive them, where draw_text() draws them before it rounds their places to pixels.
TextLine text_line(std::string_view text, const TextStyle& style);

/// A font of the texts as a TrueType file; measures in thousandths of its em.
struct FontFile {
    std::string_view bytes;
    double ascent, descent, capital;
    double left, low, right, high;   // the box around all glyphs
};
FontFile font_file(Weight weight);

}   // namespace render
