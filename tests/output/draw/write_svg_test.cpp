#include <gtest/gtest.h>

#include "output/draw/vector_sample.h"
#include "output/draw/write_drawing.h"

namespace meshfolio::output {
namespace {

using namespace testing_tools;
using render::Drawing;

TEST(WriteSvg, ShowsWhatIsPaintedInABrowser) {
    const TemporaryFolder folder;
    folder.write("drawing.svg", write_svg(sample_drawing(), sample_resolution, ""));
    folder.write("page.html", "<body style='margin: 0'><img src='drawing.svg' width=320 height=800>");
    const ChildEnd end = run_in(folder,
                                "chromium-headless-shell --no-sandbox --disable-gpu --hide-scrollbars --window-size=320,800 "
                                "--screenshot=shown.png --user-data-dir=profile file://$PWD/page.html");
    if (end.code == 127) GTEST_SKIP() << "chromium-headless-shell is not installed";
    ASSERT_EQ(end.code, 0) << end.output;
    expect_shows_the_sample(render::decode_png(read_file(folder.path() / "shown.png")).value());
}

// Whatever stands in a name of a file, the file is XML, and has the visible characters as its text.
TEST(WriteSvg, IsWellFormedWithAnyCharacters) {
    Drawing drawing{300, 100};
    for (const std::string text : {"a<b>&\"']]>--<!-- &amp;", "\x01\x1b\x7f\t\n\u202e\xff\xc3 \ufffe\uffff", "two  spaces", ""}) {
        drawing.items = {Drawing::Text{{10, 50}, text, {}}};
        const TemporaryFolder folder;
        folder.write("drawing.svg", write_svg(drawing, 96, text));
        const ChildEnd end =
            run_in(folder, "xmllint --noout drawing.svg && xmllint --xpath \"string(//*[local-name()='text'])\" drawing.svg");
        if (end.code == 127) GTEST_SKIP() << "xmllint is not installed";
        std::string visible;
        for (const render::PlacedGlyph& glyph : render::text_line(text, {}).glyphs) visible += glyph.text;
        EXPECT_EQ(end.code, 0) << end.output;
        EXPECT_EQ(end.output, visible + "\n") << text;
    }
}

TEST(WriteSvg, HasItsSizeInMillimetresAndItsPlacesInPixels) {
    const std::string svg = write_svg(Drawing{440, 110}, 220, "<title>");
    EXPECT_NE(svg.find(" width=\"50.8mm\" height=\"12.7mm\" viewBox=\"0 0 440 110\""), std::string::npos) << svg;
    EXPECT_NE(svg.find("<title>&lt;title&gt;</title>"), std::string::npos) << svg;
}

TEST(WriteSvg, HasTheFontsAndMapsThatItUsesOnce) {
    const auto count = [](const std::string& text, std::string_view part) {
        int found = 0;
        for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
        return found;
    };
    Drawing drawing{300, 100};
    EXPECT_EQ(count(write_svg(drawing, 220, ""), "@font-face"), 0);
    const Drawing::Ramp ramp{&render::colormap_named("magma"), 10, 10, 100, 20};
    for (int i = 0; i < 2; ++i) drawing.items.insert(drawing.items.end(), {ramp, Drawing::Text{{10, 50}, "words", {}}});
    const std::string svg = write_svg(drawing, 220, "");
    EXPECT_EQ(count(svg, "@font-face"), 1);
    EXPECT_EQ(count(svg, "<linearGradient"), 1);
    EXPECT_EQ(count(svg, "fill=\"url(#ramp-"), 2);
    EXPECT_EQ(svg, write_svg(drawing, 220, ""));
    const std::string all = write_svg(sample_drawing(), 220, "");
    EXPECT_EQ(count(all, "@font-face"), 2);
    EXPECT_LT(all.size(), 200'000);
}

}   // namespace
}   // namespace meshfolio::output
