#include "sheet/text.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/picture_box.h"

namespace {

using render::Align;
using render::Image;
using render::Rgba;
using render::TextStyle;
using render::Weight;
using render_tests::white;

struct Ink {
    int x0 = 1 << 20, x1 = -1, y0 = 1 << 20, y1 = -1;
    bool empty() const { return x1 < 0; }
};

Ink ink_of(const Image& image) {
    Ink e;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y) != white) e = {std::min(e.x0, x), std::max(e.x1, x), std::min(e.y0, y), std::max(e.y1, y)};
    return e;
}

Image drawn_text(std::string_view text, const TextStyle& style, double x = 100) {
    Image image(400, 60);
    render::draw_text(image, x, 40, text, style);
    return image;
}

TEST(Text, InkStaysInsideTheMeasuredWidthAndHeight) {
    for (const double size : {11.0, 13.0, 20.0, 30.0})
        for (const char* text : {"mean curvature H", "λ = 0.01, 20 iterations", "−1.5 × 10⁻⁷", "gjpq", "|"}) {
            const TextStyle style{size};
            const Ink e = ink_of(drawn_text(text, style));
            ASSERT_FALSE(e.empty()) << text;
            EXPECT_GE(e.x0, 99) << text;
            EXPECT_LE(e.x1, 100 + render::text_width(text, style) + 1) << text;
            EXPECT_LE(e.y1 - e.y0, size + 1) << text;
            EXPECT_GE(e.y0, 40 - size) << text;
        }
}

TEST(Text, WidthGrowsWithTheSizeAndAddsUp) {
    const double single = render::text_width("curvature", {16}), doubled = render::text_width("curvature", {32});
    EXPECT_NEAR(doubled, 2 * single, 1e-3);
    EXPECT_NEAR(render::text_width("aaaa", {16}), 4 * render::text_width("a", {16}), 1e-3);
    EXPECT_GT(render::text_width("curvature", {.size = 16, .weight = Weight::bold}), single);
    EXPECT_EQ(render::text_width("", {}), 0);
}

TEST(Text, IsAlignedAtItsLeftMiddleOrRight) {
    for (const auto& [align, share] : {std::pair{Align::left, 0.0}, {Align::centre, 0.5}, {Align::right, 1.0}}) {
        const TextStyle style{.size = 20, .align = align};
        const double width = render::text_width("HHHH", style);
        const Ink e = ink_of(drawn_text("HHHH", style, 200));
        EXPECT_NEAR(e.x0, 200 - share * width, 3);
        EXPECT_NEAR(e.x1, 200 + (1 - share) * width, 3);
    }
}

TEST(Text, LettersStandOnTheBaseline) { EXPECT_EQ(ink_of(drawn_text("HEN", {20})).y1, 39); }

// Flat and round letters begin and end with the same rows, at all sizes and in both weights.
TEST(Text, SmallLettersEndOnTheSameRows) {
    for (const Weight weight : {Weight::regular, Weight::bold})
        for (double size = 10; size <= 24; size += 0.5) {
            const TextStyle style{.size = size, .weight = weight};
            const int x_height = ink_of(drawn_text("x", style)).y0, capital = ink_of(drawn_text("H", style)).y0;
            for (const char* letter : {"z", "v", "o", "e", "s", "a", "c"}) {
                EXPECT_EQ(ink_of(drawn_text(letter, style)).y0, x_height) << letter << size;
                EXPECT_EQ(ink_of(drawn_text(letter, style)).y1, 39) << letter << size;
            }
            for (const char* letter : {"E", "O", "S", "0", "8"}) {
                EXPECT_EQ(ink_of(drawn_text(letter, style)).y0, capital) << letter << size;
                EXPECT_EQ(ink_of(drawn_text(letter, style)).y1, 39) << letter << size;
            }
        }
}

/// The longest run of full ink in a row.
int longest_bar(const Image& image, Rgba ink) {
    int longest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0, run = 0; x < image.width; ++x) {
            run = image.at(x, y) == ink ? run + 1 : 0;
            longest = std::max(longest, run);
        }
    return longest;
}

// Thin horizontal bars fill a row of pixels instead of greying two.
TEST(Text, HorizontalBarsAreFullyInked) {
    for (double size = 10; size <= 20; size += 0.5)
        for (const char* letter : {"z", "E", "H", "e", "=", "\u2212", "+", "t", "2", "["}) {
            if (*letter == '[' && size < 11) continue;   // one and a half pixels wide
            const TextStyle style{size};
            const double least = *letter == 't' || *letter == '[' ? 0 : 0.12 * size;
            EXPECT_GT(longest_bar(drawn_text(letter, style), style.color), least) << letter << " at " << size;
        }
}

// Heights are rounded to rows, no more: capitals within half a pixel of 2048/2816 of the em (Inter), small letters of 1536.
TEST(Text, FittingMovesEdgesByHalfAPixelAtMost) {
    for (double size = 10; size <= 50; size += 0.7) {
        EXPECT_NEAR(40 - ink_of(drawn_text("H", {size})).y0, size / 1.164 * 2048 / 2816, 0.51) << size;
        EXPECT_NEAR(40 - ink_of(drawn_text("x", {size})).y0, size / 1.164 * 1536 / 2816, 0.51) << size;
    }
}

// Wherever a stem falls between two columns of pixels, one of them is dark.
TEST(Text, StemsAreDarkAtAnyFractionOfAPixel) {
    for (const double size : {11.0, 12.0, 13.0, 16.0})
        for (double x = 100; x < 101; x += 0.125) {
            const Image image = drawn_text("l", {.size = size, .color = {0, 0, 0, 255}}, x);
            const int darkest = std::min_element(image.pixels.begin(), image.pixels.end(), [](Rgba a, Rgba b) { return a.r < b.r; })->r;
            EXPECT_LT(darkest, 115) << size << " at " << x;
        }
}

TEST(Text, SmallTextIsDark) {
    const Image image = drawn_text("lineill", {12});
    const int darkest = std::min_element(image.pixels.begin(), image.pixels.end(), [](Rgba a, Rgba b) { return a.r < b.r; })->r;
    EXPECT_LT(darkest, 110);
}

TEST(Text, AMarkStandsInTheMiddleAboveItsLetter) {
    for (const char* letter : {"h", "x", "c", "\u03b8", "T"}) {
        const std::string marked = std::string(letter) + "\u0304";
        for (const double size : {12.0, 20.0, 30.0}) {
            const Image plain = drawn_text(letter, {size}), both = drawn_text(marked, {size});
            const Ink below = ink_of(plain);
            Ink mark;
            for (int y = 0; y < both.height; ++y)
                for (int x = 0; x < both.width; ++x)
                    if (both.at(x, y) != plain.at(x, y))
                        mark = {std::min(mark.x0, x), std::max(mark.x1, x), std::min(mark.y0, y), std::max(mark.y1, y)};
            ASSERT_FALSE(mark.empty()) << marked << size;
            EXPECT_LT(mark.y1, below.y0) << marked << size;
            EXPECT_GT(mark.y1, below.y0 - 0.3 * size) << marked << size;
            EXPECT_NEAR(mark.x0 + mark.x1, below.x0 + below.x1, 2.1) << marked << size;
            EXPECT_EQ(render::text_width(marked, {size}), render::text_width(letter, {size})) << marked;
        }
    }
}

TEST(Text, ControlCharactersAndDirectionMarksAreNotDrawn) {
    EXPECT_TRUE(ink_of(drawn_text("\n\t\x01\x7f", {20})).empty());
    EXPECT_EQ(drawn_text("a\u202e\u200bb\n", {20}).pixels, drawn_text("ab", {20}).pixels);
}

TEST(Text, UnknownCharactersAndInvalidUtf8AreBoxes) {
    EXPECT_FALSE(ink_of(drawn_text("\U0001F9FF", {20})).empty());
    EXPECT_EQ(drawn_text("\xff", {20}).pixels, drawn_text("\uFFFD", {20}).pixels);
    EXPECT_EQ(drawn_text("\xc3", {20}).pixels, drawn_text("\uFFFD", {20}).pixels);             // cut short
    EXPECT_EQ(drawn_text("\xc0\xaf", {20}).pixels, drawn_text("\uFFFD\uFFFD", {20}).pixels);   // overlong
    EXPECT_EQ(drawn_text("\xe2\x82z", {20}).pixels, drawn_text("\uFFFD\uFFFDz", {20}).pixels);
}

TEST(Text, TextOutsideThePictureIsCutOff) {
    Image image(30, 10);
    render::draw_text(image, -20, 5, "Wide text on a small picture", {24});
    render::draw_text(image, 25, -30, "above", {24});
    render::draw_text(image, 1e6, 5, "beside", {24});
    EXPECT_FALSE(ink_of(image).empty());
}

std::string characters_of(const render::TextLine& line) {
    std::string text;
    for (const render::PlacedGlyph& glyph : line.glyphs) text += glyph.text;
    return text;
}

TEST(TextLine, EachGlyphEndsWhereTheTextUpToItEnds) {
    const std::string text = "AVATAR To \u03bb 10\u207b\u2077";
    const render::TextLine line = render::text_line(text, {17});
    EXPECT_EQ(characters_of(line), text);
    std::string before;
    for (const render::PlacedGlyph& glyph : line.glyphs) {
        before += glyph.text;
        EXPECT_NEAR(glyph.place + glyph.advance, render::text_width(before, {17}), 1e-9) << before;
        EXPECT_EQ(glyph.rise, 0);
    }
    EXPECT_EQ(line.width, render::text_width(text, {17}));
}

TEST(TextLine, BeginsWhereItsAlignmentSays) {
    for (const auto& [align, share] : {std::pair{Align::left, 0.0}, {Align::centre, 0.5}, {Align::right, 1.0}}) {
        const render::TextLine line = render::text_line("HHHH", {.align = align});
        EXPECT_EQ(line.left, -share * line.width);
    }
}

TEST(TextLine, HasValidTextWithoutInvisibleCharacters) {
    const std::string text = "a\n\u200b\xff\uFFFF\U0001F9FFz";
    EXPECT_EQ(characters_of(render::text_line(text, {})), "a\uFFFD\uFFFD\U0001F9FFz");
}

TEST(TextLine, MarksAreRaisedAboveHighLetters) {
    const render::TextLine line = render::text_line("x\u0304H\u0304", {20});
    ASSERT_EQ(line.glyphs.size(), 4);
    EXPECT_EQ(line.glyphs[1].rise, 0);
    EXPECT_NEAR(line.glyphs[3].rise, line.em * (2048 - 1536) / 2816, 0.01);   // from x to H, of Inter
    EXPECT_EQ(line.glyphs[2].place, line.glyphs[0].advance);                  // a mark moves nothing
}

TEST(FontFile, HasItsMeasuresInThousandthsOfTheEm) {
    for (const Weight weight : {Weight::regular, Weight::bold}) {
        const render::FontFile font = render::font_file(weight);
        EXPECT_EQ(font.bytes.substr(0, 4), std::string_view("\0\1\0\0", 4));
        EXPECT_NEAR(font.capital, 1000.0 * 2048 / 2816, 0.5);
        EXPECT_NEAR(font.ascent - font.descent, 1000 * 20 / render::text_line("", {20}).em, 60);   // a line is as high as the size
        EXPECT_LE(font.low, font.descent + 100);
        EXPECT_GE(font.high, font.capital);
    }
}

TEST(FitText, FitsAndKeepsWhatFits) {
    const TextStyle style{14};
    const std::string text = "smoothing of größe λ with many words";
    EXPECT_EQ(render::fit_text(text, 1000, style), text);
    std::size_t longest = text.size() + 8;
    for (double width = 300; width > 0; width -= 7) {
        const std::string fitted = render::fit_text(text, width, style);
        EXPECT_LE(render::text_width(fitted, style), width);
        EXPECT_LE(fitted.size(), longest);
        EXPECT_TRUE(fitted.empty() || fitted == text || fitted.ends_with("…")) << fitted;
        longest = fitted.size();
    }
    EXPECT_EQ(render::fit_text(text, 0.5, style), "");
}

}   // namespace
