#include <gtest/gtest.h>

#include "output/draw/vector_sample.h"
#include "output/draw/write_drawing.h"

namespace meshfolio::output {
namespace {

using namespace testing_tools;
using render::Drawing;

const std::string hostile = "a<b>&\"'(\\)\x01\x7f\xff\n \u4e2d]]>--";

Drawing words(const std::vector<std::string>& lines, render::Weight weight = render::Weight::regular) {
    Drawing drawing{400, 300};
    for (const std::string& line : lines)
        drawing.items.push_back(Drawing::Text{{20, 30 + 30.0 * double(drawing.items.size())}, line, {.size = 20, .weight = weight}});
    return drawing;
}

/// What a command of poppler or qpdf says of a drawing's PDF; code 127 if it is not installed.
ChildEnd told_of(const Drawing& drawing, const std::string& command, const std::string& title = "") {
    const TemporaryFolder folder;
    folder.write("drawing.pdf", write_pdf(drawing, sample_resolution, title));
    return run_in(folder, command);
}

TEST(WritePdf, ShowsWhatIsPainted) {
    const TemporaryFolder folder;
    folder.write("drawing.pdf", write_pdf(sample_drawing(), sample_resolution, ""));
    const ChildEnd end = run_in(folder, "pdftocairo -png -singlefile -r 220 drawing.pdf shown");
    if (end.code == 127) GTEST_SKIP() << "poppler-utils is not installed";
    ASSERT_EQ(end.code, 0) << end.output;
    expect_shows_the_sample(render::decode_png(read_file(folder.path() / "shown.png")).value());
}

TEST(WritePdf, HasTheWordsInReadingOrder) {
    const ChildEnd end = told_of(words({sample_words, more_sample_words, "two  spaces"}), "pdftotext -raw drawing.pdf -");
    if (end.code == 127) GTEST_SKIP() << "poppler-utils is not installed";
    EXPECT_EQ(end.output, sample_words + "\n" + more_sample_words + "\ntwo spaces\n\f");
}

TEST(WritePdf, EmbedsTheFontsThatItUses) {
    const auto fonts = [](const Drawing& drawing) { return told_of(drawing, "pdffonts drawing.pdf | tail -n +3"); };
    if (fonts({}).code == 127) GTEST_SKIP() << "poppler-utils is not installed";
    EXPECT_EQ(fonts(words({""})).output, "");
    for (const auto& [weight, name] :
         {std::pair{render::Weight::regular, "ReportSans-Regular"}, {render::Weight::bold, "ReportSans-Bold"}}) {
        const std::string table = fonts(words({"words"}, weight)).output;
        EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1) << table;
        EXPECT_TRUE(table.starts_with(name)) << table;
        EXPECT_NE(table.find("CID TrueType      Identity-H       yes no  yes"), std::string::npos)
            << table;   // embedded, whole, with ToUnicode
    }
}

TEST(WritePdf, HasTitleAndSize) {
    const ChildEnd end = told_of(Drawing{440, 110}, "pdfinfo drawing.pdf", "T\u00edtle (\u03bb) \x01\xff");
    if (end.code == 127) GTEST_SKIP() << "poppler-utils is not installed";
    EXPECT_NE(end.output.find("Title:           T\u00edtle (\u03bb) \\x01\\xff\n"), std::string::npos) << end.output;
    EXPECT_NE(end.output.find("Page size:       144 x 36 pts"), std::string::npos) << end.output;
}

TEST(WritePdf, IsValidWithAnyCharacters) {
    const ChildEnd end = told_of(words({hostile}), "qpdf --check drawing.pdf", hostile);
    if (end.code == 127) GTEST_SKIP() << "qpdf is not installed";
    EXPECT_EQ(end.code, 0);
    EXPECT_EQ(end.output.find("WARNING"), std::string::npos) << end.output;
    EXPECT_EQ(told_of(sample_drawing(), "qpdf --check drawing.pdf").code, 0);
}

TEST(WritePdf, IsSmallAndAlwaysTheSame) {
    const std::string once = write_pdf(sample_drawing(), 220, "title");
    EXPECT_EQ(write_pdf(sample_drawing(), 220, "title"), once);
    EXPECT_NE(write_pdf(sample_drawing(), 220, "other"), once);
    Drawing both = words({"regular"});
    both.add(words({"bold"}, render::Weight::bold), 0, 30);
    EXPECT_LT(write_pdf(both, 220, "").size(), 100'000);
}

}   // namespace
}   // namespace meshfolio::output
