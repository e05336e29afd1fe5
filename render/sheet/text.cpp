#include "sheet/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "embedded_fonts.h"
#include "sheet/grid_fit.h"
#include "sheet/strokes.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_truetype.h>

namespace render {

namespace {

constexpr char32_t replacement = 0xFFFD;
constexpr double line_in_ems = 1.164;   // from ascender to descender

/// Removes the first character of `text` and returns it; U+FFFD for each byte that is not UTF-8.
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

/// True for control characters, soft hyphens, zero-width, direction and byte order marks.
bool is_invisible(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xAD || (c >= 0x200B && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
           (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF;
}

struct Font {
    std::string_view bytes;
    stbtt_fontinfo info;
    FontLines lines;
    double scale;   // pixels per font unit, at a size of 1
};

struct Box {
    double left, low, right, high;
};

Box box_of(const stbtt_fontinfo& font, int glyph) {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;   // of a glyph without ink
    stbtt_GetGlyphBox(&font, glyph, &x0, &y0, &x1, &y1);
    return {double(x0), double(y0), double(x1), double(y1)};
}

Font loaded(std::string_view name) {
    Font font{};
    for (const auto& file : meshfolio_embedded::embedded_fonts()) {
        if (file.name != name || stbtt_InitFont(&font.info, reinterpret_cast<const unsigned char*>(file.bytes.data()), 0) == 0) continue;
        const auto box = [&](char c) { return box_of(font.info, stbtt_FindGlyphIndex(&font.info, c)); };
        font.bytes = file.bytes;
        font.lines = {box('p').low, box('x').high, box('H').high, box('d').high, -box('o').low};
        font.scale = double(stbtt_ScaleForMappingEmToPixels(&font.info, 1)) / line_in_ems;
        return font;
    }
    throw std::runtime_error("text: the font " + std::string(name) + " is not embedded");
}

const Font& font_of(Weight weight) {
    static const Font regular = loaded("sans-regular.ttf"), bold = loaded("sans-bold.ttf");
    return weight == Weight::bold ? bold : regular;
}

/// A line of glyphs. Characters that the font lacks become its box.
struct Line : TextLine {
    const Font& font;
    double size, scale;   // in pixels; in pixels per font unit

    Line(std::string_view text, const TextStyle& style) : font(font_of(style.weight)), size(style.size), scale(font.scale * size) {
        while (!text.empty()) {
            const std::string_view before = text;
            const char32_t c = next_character(text);
            if (is_invisible(c)) continue;
            const bool is_known = c != replacement && c != 0xFFFE && c != 0xFFFF;   // the last two are no characters of XML
            const std::string_view bytes = is_known ? before.substr(0, before.size() - text.size()) : "\uFFFD";
            const int glyph = stbtt_FindGlyphIndex(&font.info, static_cast<int>(c));
            int advance = 0, bearing = 0;
            stbtt_GetGlyphHMetrics(&font.info, glyph, &advance, &bearing);
            if (c >= 0x300 && c < 0x370 && !glyphs.empty()) {   // a combining mark, without width
                glyphs.push_back(above(glyphs.back(), {glyph, bytes, 0, scale * advance}));
                continue;
            }
            if (!glyphs.empty()) width += scale * stbtt_GetGlyphKernAdvance(&font.info, glyphs.back().index, glyph);
            glyphs.push_back({glyph, bytes, width, scale * advance});
            width += scale * advance;
        }
        left = style.align == Align::left ? 0 : style.align == Align::right ? -width : -width / 2;
        em = size / line_in_ems;
    }

    /// Centres a mark above a letter.
    PlacedGlyph above(const PlacedGlyph& letter, PlacedGlyph mark) const {
        const Box below = box_of(font.info, letter.index), box = box_of(font.info, mark.index);
        mark.place = letter.place + scale / 2 * (below.left + below.right - box.left - box.right);
        mark.rise = letter.rise + scale * std::max(0.0, below.high - font.lines.x_height);
        return mark;
    }
};

/// The lines and quadratic curves of a glyph.
struct Outline {
    std::unique_ptr<stbtt_vertex, decltype(&std::free)> points{nullptr, std::free};
    int count = 0;

    Outline(const stbtt_fontinfo& font, int glyph) {
        stbtt_vertex* vertices = nullptr;
        count = stbtt_GetGlyphShape(&font, glyph, &vertices);
        points.reset(vertices);
    }
    std::span<stbtt_vertex> all() const { return {points.get(), static_cast<std::size_t>(count)}; }
};

/// Returns the horizontal edges of an outline at least `shortest` font units long. TrueType outlines have the ink on their right: an edge
/// that runs to the right is a top. Curves have an edge where they end level.
std::vector<HorizontalEdge> horizontal_edges(const Outline& outline, int shortest) {
    std::vector<HorizontalEdge> edges;
    int x = 0, y = 0;
    for (const stbtt_vertex& v : outline.all()) {
        const int run = v.x - x;
        const auto is_level = [&](int rise) { return 50 * std::abs(rise) <= std::abs(run); };
        const bool level_start = is_level((v.type == STBTT_vcurve ? v.cy : v.y) - y);
        const bool level_end = v.type == STBTT_vcurve && is_level(v.y - v.cy);
        if (v.type != STBTT_vmove && std::abs(run) >= shortest) {
            if (level_start) edges.push_back({double(y), run > 0});
            if (level_end) edges.push_back({double(v.y), run > 0});
        }
        x = v.x, y = v.y;
    }
    return edges;
}

/// Units of fitted heights per font unit; whole font units would let faint ink into the next row.
constexpr int fine = 8;

/// The coverage of the pixels of a box by a glyph.
struct Coverage {
    int x0 = 0, y0 = 0, width = 0, height = 0;   // of the box, y down from the baseline
    std::vector<unsigned char> bytes;

    Coverage(const Outline& outline, float scale, float shift, double size) {
        double left = INFINITY, right = -INFINITY, low = INFINITY, high = -INFINITY;
        for (const stbtt_vertex& v : outline.all())
            for (const auto& [x, y] : {std::pair(v.x, v.y), v.type == STBTT_vcurve ? std::pair(v.cx, v.cy) : std::pair(v.x, v.y)}) {
                left = std::min<double>(left, x), right = std::max<double>(right, x);
                low = std::min<double>(low, y), high = std::max<double>(high, y);
            }
        if (!(left < right) || !(low < high)) return;
        const auto s = static_cast<double>(scale), dx = static_cast<double>(shift);
        x0 = static_cast<int>(std::floor(s * left + dx)), y0 = static_cast<int>(std::floor(1e-3 - s / fine * high));
        width = static_cast<int>(std::ceil(s * right + dx)) - x0, height = static_cast<int>(std::ceil(-s / fine * low - 1e-3)) - y0;
        bytes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        stbtt__bitmap bitmap{width, height, width, bytes.data()};
        stbtt_Rasterize(&bitmap, 0.2F, outline.points.get(), outline.count, scale, scale / fine, shift, 0, x0, y0, 1, nullptr);
        for (unsigned char& b : bytes) b = boosted(b, size);
    }
    /// Returns the coverage in [0, 1] of a pixel of the box.
    float at(int u, int v) const {
        return static_cast<float>(bytes[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)]) / 255;
    }

    /// Raises partial coverage c of small text to c + a c (1 − c), so that stems across two columns of pixels look as dark as in one.
    static unsigned char boosted(unsigned char coverage, double size) {
        const double c = coverage / 255.0, a = 0.4 * std::clamp((24 - size) / 12, 0.0, 1.0);
        return static_cast<unsigned char>(std::lround(255 * (c + a * c * (1 - c))));
    }
};

/// Draws a glyph with its heights fitted to rows of pixels and its origin rounded to a quarter of a pixel.
void draw_glyph(Image& image, const Line& line, const PlacedGlyph& glyph, double left, double base, Rgba color) {
    const double quarters = std::floor(4 * (left + glyph.place) + 0.5);
    const int column = static_cast<int>(std::floor(quarters / 4)), baseline = static_cast<int>(std::lround(base - glyph.rise));
    const Outline outline(line.font.info, glyph.index);
    const FontLines& lines = line.font.lines;
    const GridFit fit(lines, horizontal_edges(outline, static_cast<int>(0.1 * lines.x_height)), line.scale);
    const auto fitted = [&](int y) { return static_cast<short>(std::clamp(std::lround(fine * fit(y) / line.scale), -32767L, 32767L)); };
    for (stbtt_vertex& v : outline.all()) v.y = fitted(v.y), v.cy = fitted(v.cy);
    const Coverage ink(outline, static_cast<float>(line.scale), static_cast<float>(quarters / 4 - column), line.size);
    for (int v = std::max(0, -(baseline + ink.y0)); v < ink.height && baseline + ink.y0 + v < image.height; ++v)
        for (int u = std::max(0, -(column + ink.x0)); u < ink.width && column + ink.x0 + u < image.width; ++u) {
            Rgba& pixel = image.at(column + ink.x0 + u, baseline + ink.y0 + v);
            pixel = inked(pixel, color, ink.at(u, v));
        }
}

}   // namespace

double text_width(std::string_view text, const TextStyle& style) { return Line(text, style).width; }

void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style) {
    const Line line(text, style);
    for (const PlacedGlyph& glyph : line.glyphs) draw_glyph(image, line, glyph, x + line.left, y, style.color);
}

TextLine text_line(std::string_view text, const TextStyle& style) { return Line(text, style); }

FontFile font_file(Weight weight) {
    const Font& font = font_of(weight);
    const double unit = 1000 * double(stbtt_ScaleForMappingEmToPixels(&font.info, 1));
    int ascent = 0, descent = 0, gap = 0, left = 0, low = 0, right = 0, high = 0;
    stbtt_GetFontVMetrics(&font.info, &ascent, &descent, &gap);
    stbtt_GetFontBoundingBox(&font.info, &left, &low, &right, &high);
    return {font.bytes, unit * ascent, unit * descent, unit * font.lines.capital, unit * left, unit * low, unit * right, unit * high};
}

std::string fit_text(std::string_view text, double width, const TextStyle& style) {
    if (text_width(text, style) <= width) return std::string(text);
    std::string fitted;
    for (std::string_view rest = text; !rest.empty();) {
        next_character(rest);
        std::string_view kept = text.substr(0, text.size() - rest.size());
        while (kept.ends_with(' ')) kept.remove_suffix(1);
        const std::string longer = std::string(kept) + "…";
        if (text_width(longer, style) > width) break;
        fitted = longer;
    }
    return fitted;
}

}   // namespace render
