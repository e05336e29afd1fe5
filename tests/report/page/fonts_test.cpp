// Every character of our own words stands in a font that is compiled in: none is left to what a machine has.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "base/file_bytes.h"
#include "embedded_page_fonts.h"
#include "math-regular.h"
#include "mono-regular.h"
#include "report/writers.h"
#include "sans-bold.h"
#include "sans-italic.h"
#include "sans-regular.h"
#include "serif-bold.h"
#include "serif-italic.h"
#include "serif-regular.h"
#include "source_dir.h"

namespace meshfolio::report {
namespace {

namespace fs = std::filesystem;
const fs::path root = MESHFOLIO_SOURCE_DIR;

using Characters = std::set<char32_t>;

template <class... Faces> Characters held_by(const Faces&... faces) {
    Characters held;
    const auto add = [&](const auto& face) {
        for (const auto& entry : face) held.insert(entry.character);
    };
    (add(faces), ...);
    return held;
}

/// Printed ones; the text is valid UTF-8.
Characters characters_of(const std::string& text) {
    Characters all;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
        char32_t c = length == 1 ? lead : lead & (0x7FU >> length);
        for (std::size_t k = 1; k < length; ++k) c = c << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
        if (c >= 0x20 && c != 0x2060) all.insert(c);   // a word joiner has no picture
        i += length;
    }
    return all;
}

/// All files below a folder of the source that end so, without the comments of C++.
std::string texts_below(const std::string& folder, const std::set<std::string>& ends) {
    std::string text;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
        if (ends.contains(entry.path().extension().string())) text += read_file(entry.path());
    return ends.contains(".cpp") ? std::regex_replace(text, std::regex("//[^\n]*"), "") : text;
}

std::string missing_from(const Characters& characters, const Characters& held) {
    std::ostringstream missing;
    for (const char32_t c : characters)
        if (!held.contains(c)) missing << "U+" << std::hex << static_cast<std::uint32_t>(c) << " ";
    return missing.str();
}

TEST(Fonts, HoldEveryCharacterOfOurWords) {
    const Characters others = held_by(math_regular_widths, mono_regular_widths);
    const std::string words = texts_below("templates", {".md", ".html", ".css", ".js", ".json"}) + texts_below("src", {".cpp", ".h"});
    for (Characters held : {held_by(serif_regular_widths), held_by(sans_regular_widths)}) {
        held.insert(others.begin(), others.end());
        EXPECT_EQ(missing_from(characters_of(words), held), "");
        EXPECT_NE(missing_from(characters_of("\u4e2d"), held), "");
    }
}

TEST(Fonts, HoldEveryCharacterOfTheFormulas) {
    EXPECT_EQ(missing_from(characters_of(read_file(root / "templates/formulas.json")), held_by(math_regular_widths, serif_regular_widths)),
              "");
}

TEST(Fonts, HoldEveryCharacterOfAPictureInBothWeights) {
    const Characters drawn = characters_of(texts_below("render", {".cpp", ".h"}) + texts_below("src/output/draw", {".cpp", ".h"}));
    EXPECT_EQ(missing_from(drawn, held_by(sans_regular_widths)) + missing_from(drawn, held_by(sans_bold_widths)), "");
}

// A bold or italic word is not set in two fonts.
TEST(Fonts, HoldTheSameLettersInEveryFace) {
    const auto letters = [](const Characters& held) {
        Characters few;
        for (const char32_t c : held)
            if (c < 0x400 || (c >= 0x2010 && c < 0x2090)) few.insert(c);
        return few;
    };
    const Characters serif = letters(held_by(serif_regular_widths)), sans = letters(held_by(sans_regular_widths));
    EXPECT_EQ(missing_from(serif, held_by(serif_bold_widths)) + missing_from(serif, held_by(serif_italic_widths)), "");
    EXPECT_EQ(missing_from(sans, held_by(sans_bold_widths)) + missing_from(sans, held_by(sans_italic_widths)), "");
    const Characters least = characters_of("Az09éñąΔλφ×·²⁻⁵₀½–“”…");
    EXPECT_EQ(missing_from(least, serif) + missing_from(least, sans), "");
}

TEST(Fonts, TakeFourHundredKilobytesAtMost) {
    std::size_t bytes = 0;
    for (const auto& font : meshfolio_embedded::embedded_page_fonts()) {
        EXPECT_TRUE(font.bytes.starts_with("wOF2")) << font.name;
        EXPECT_NE(Templates()["fonts.css"].find("url(" + std::string(font.name) + ")"), std::string::npos) << font.name;
        bytes += font.bytes.size();
    }
    EXPECT_EQ(meshfolio_embedded::embedded_page_fonts().size(), 8U);
    EXPECT_LE(bytes, 400'000U);
}

}   // namespace
}   // namespace meshfolio::report
