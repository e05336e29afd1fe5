#include "text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "embedded_fonts.h"
#include "strokes.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_truetype.h>

namespace render {

namespace {

constexpr char32_t replacement = 0xFFFD;

/// Takes one character off the front of `text`; U+FFFD for each byte that is not UTF-8.
char32_t next_character(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    char32_t c = length == 1 ? first : length == 0 ? replacement : first & (0x7F >> length);
    bool valid = length > 0 && length <= text.size();
    for (std::size_t i = 1; valid && i < length; ++i) {
        valid = (byte(i) & 0xC0) == 0x80;
        c = c << 6 | (byte(i) & 0x3F);
    }
    static constexpr std::array<char32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    valid = valid && c >= smallest[length] && c <= 0x10FFFF && (c < 0xD800 || c > 0xDFFF);
    text.remove_prefix(valid ? length : 1);
    return valid ? c : replacement;
}

/// Control characters, soft hyphens, zero-width and direction marks, byte order marks: they have no picture.
bool is_invisible(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xAD || (c >= 0x200B && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
           (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF;
}

std::vector<int> code_points(std::string_view text) {
    std::vector<int> result;
    while (!text.empty())
        if (const char32_t c = next_character(text); !is_invisible(c)) result.push_back(static_cast<int>(c));
    return result;
}

stbtt_fontinfo loaded(std::string_view name) {
    for (const auto& file : meshfolio_embedded::embedded_fonts()) {
        stbtt_fontinfo font;
        const auto* bytes = reinterpret_cast<const unsigned char*>(file.bytes.data());
        if (file.name == name && stbtt_InitFont(&font, bytes, stbtt_GetFontOffsetForIndex(bytes, 0)) != 0) return font;
    }
    throw std::runtime_error("text: the font " + std::string(name) + " is not embedded");
}

const stbtt_fontinfo& font_of(Weight weight) {
    static const stbtt_fontinfo regular = loaded("DejaVuSans.ttf"), bold = loaded("DejaVuSans-Bold.ttf");
    return weight == Weight::bold ? bold : regular;
}

/// A line of glyphs with their places from the left end, in pixels. Characters the font lacks become its box.
struct Line {
    const stbtt_fontinfo& font;
    float scale;
    std::vector<int> glyphs;
    std::vector<double> places;
    double width = 0;

    Line(std::string_view text, const TextStyle& style)
        : font(font_of(style.weight)), scale(stbtt_ScaleForPixelHeight(&font, static_cast<float>(style.size))) {
        for (const int c : code_points(text)) {
            const int glyph = stbtt_FindGlyphIndex(&font, c);
            if (!glyphs.empty()) width += static_cast<double>(scale) * stbtt_GetGlyphKernAdvance(&font, glyphs.back(), glyph);
            glyphs.push_back(glyph);
            places.push_back(width);
            int advance = 0, bearing = 0;
            stbtt_GetGlyphHMetrics(&font, glyph, &advance, &bearing);
            width += static_cast<double>(scale) * advance;
        }
    }
};

/// `x` is the origin of the glyph in quarters of a pixel, so that letters keep their distances.
void draw_glyph(Image& image, const Line& line, int glyph, double x, int baseline, Rgba color) {
    const double quarters = std::floor(4 * x + 0.5);
    const int column = static_cast<int>(std::floor(quarters / 4));
    const float shift = static_cast<float>(quarters / 4 - column);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&line.font, glyph, line.scale, line.scale, shift, 0, &x0, &y0, &x1, &y1);
    const int width = x1 - x0, height = y1 - y0;
    if (width <= 0 || height <= 0) return;
    std::vector<unsigned char> coverage(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    stbtt_MakeGlyphBitmapSubpixel(&line.font, coverage.data(), width, height, width, line.scale, line.scale, shift, 0, glyph);
    for (int v = std::max(0, -(baseline + y0)); v < height && baseline + y0 + v < image.height; ++v)
        for (int u = std::max(0, -(column + x0)); u < width && column + x0 + u < image.width; ++u) {
            const auto c = coverage[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
            Rgba& pixel = image.at(column + x0 + u, baseline + y0 + v);
            pixel = inked(pixel, color, static_cast<float>(c) / 255);
        }
}

}   // namespace

double text_width(std::string_view text, const TextStyle& style) { return Line(text, style).width; }

void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style) {
    const Line line(text, style);
    const double left = style.align == Align::left ? x : style.align == Align::right ? x - line.width : x - line.width / 2;
    for (std::size_t i = 0; i < line.glyphs.size(); ++i)
        draw_glyph(image, line, line.glyphs[i], left + line.places[i], static_cast<int>(std::lround(y)), style.color);
}

std::string fit_text(std::string_view text, double width, const TextStyle& style) {
    if (text_width(text, style) <= width) return std::string(text);
    static constexpr std::string_view ellipsis = "…";
    std::vector<std::size_t> ends{0};   // of the first 0, 1, 2 … characters
    for (std::string_view rest = text; !rest.empty();) {
        next_character(rest);
        ends.push_back(text.size() - rest.size());
    }
    const auto shortened = [&](std::size_t count) {
        std::string_view kept = text.substr(0, ends[count]);
        while (kept.ends_with(' ')) kept.remove_suffix(1);
        return std::string(kept) + std::string(ellipsis);
    };
    std::size_t fits = 0, too_long = ends.size();   // bisection; widths grow with the number of characters
    while (too_long - fits > 1) {
        const std::size_t middle = (fits + too_long) / 2;
        (text_width(shortened(middle), style) <= width ? fits : too_long) = middle;
    }
    const std::string result = shortened(fits);
    return text_width(result, style) <= width ? result : "";
}

}   // namespace render
