#include "run/one_mesh/colormap_choice.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <string>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "color/srgb.h"
#include "damaged_bytes.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::run;
using render::Colormap;
using render::Rgba;

namespace {

class ColormapFile : public ::testing::Test {
protected:
    ColorChoice read(std::string_view text) {
        write_file(file, text);
        return colormap_choice(file);
    }
    std::string refusal(std::string_view text) {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    const testing_tools::TemporaryFolder folder;
    const std::string file = (folder.path() / "map.txt").string();
};

TEST(ColormapChoiceOf, BundledMapsHaveNamesAndWarnings) {
    EXPECT_EQ(colormap_choice("Viridis").name, "viridis");
    EXPECT_EQ(colormap_choice("viridis").own_map, nullptr);
    EXPECT_EQ(colormap_choice("viridis").warning, "");
    EXPECT_EQ(colormap_choice("jet").warning,
              "colour map jet is not perceptually uniform: its lightness goes up and down; viridis shows equal steps as equal");
    EXPECT_TRUE(colormap_choice("seismic").warning.ends_with("; diverging shows equal steps as equal"));
}

TEST(ColormapChoiceOf, AnUnderlineAndRReverseAMap) {
    const ColorChoice choice = colormap_choice("rdbu_r");
    EXPECT_EQ(choice.name, "RdBu_r");
    ASSERT_TRUE(choice.own_map);
    for (int i = 0; i <= 10; ++i)
        EXPECT_EQ(render::color_at(*choice.own_map, i / 10.0), render::color_at(render::colormap_named("RdBu"), 1 - i / 10.0));
    EXPECT_EQ(choice.own_map->kind, "diverging");
    EXPECT_FALSE(colormap_choice("jet_r").warning.empty());
}

TEST(ColormapChoiceOf, UnknownWordsGetTheNearestName) {
    try {
        colormap_choice("virids");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean 'viridis'?"), std::string::npos) << error.what();
    }
    EXPECT_THROW(colormap_choice(""), UsageError);
    EXPECT_THROW(colormap_choice("_r"), UsageError);
    EXPECT_THROW(colormap_choice("missing.csv"), InputError);
    EXPECT_THROW(colormap_choice("."), InputError);
    EXPECT_THROW(colormap_choice("/dev/null"), InputError);
}

TEST_F(ColormapFile, RowsOfEachFormAreTheSameMap) {
    const std::vector<Rgba> expected{{0, 0, 255, 255}, {255, 255, 255, 255}, {255, 0, 0, 255}};
    for (const char* text :
         {"0,0,1\n1,1,1\n1,0,0\n", "0 0 255\r\n255 255 255\r\n255 0 0", "r;g;b\n0;0;1\n1;1;1\n1;0;0\n",
          "# a map\n% of MATLAB\n\n0\t0\t1\n1 1 1 # white\n  1  0  0\n", "\xef\xbb\xbfr,g,b\n0, 0, 1\n1, 1, 1\n1, 0, 0\n"})
        EXPECT_EQ(read(text).own_map->stops, expected) << text;
    EXPECT_EQ(read("0,0,1\n1,1,1\n1,0,0\n").own_map->kind, "diverging");
    EXPECT_EQ(read(R"({"ColorSpace": "Diverging", "RGBPoints": [0, 0, 0, 1, 1, 1, 0, 0]})").own_map->kind, "diverging") << "through grey";
    EXPECT_EQ(read("0,0,1\n1,1,1\n1,0,0\n").name, file);
}

TEST_F(ColormapFile, PlacesAreKept) {
    const std::shared_ptr<const Colormap> map = read("x,r,g,b\n-2,0,0,0\n-1,1,0,0\n2,1,1,0\n").own_map;
    EXPECT_EQ(render::color_at(*map, 0), (Rgba{0, 0, 0, 255}));
    EXPECT_EQ(render::color_at(*map, 0.25), (Rgba{255, 0, 0, 255}));
    EXPECT_EQ(render::color_at(*map, 0.625), (Rgba{255, 128, 0, 255}));
    EXPECT_EQ(render::color_at(*map, 1), (Rgba{255, 255, 0, 255}));
    const std::shared_ptr<const Colormap> jump = read("0 0 0 0\n0.5 0 0 0\n0.5 1 1 1\n1 1 1 1\n").own_map;
    EXPECT_EQ(render::color_at(*jump, 0.49), (Rgba{0, 0, 0, 255}));
    EXPECT_EQ(render::color_at(*jump, 0.51), (Rgba{255, 255, 255, 255}));
}

// A bundled map that is written and read again is the same.
TEST_F(ColormapFile, RoundTrip) {
    for (const Colormap& map : render::colormap_list()) {
        std::string text;
        for (const Rgba c : map.stops) text += std::to_string(c.r) + "," + std::to_string(c.g) + "," + std::to_string(c.b) + "\n";
        const ColorChoice choice = read(text);
        EXPECT_EQ(choice.own_map->stops, map.stops) << map.name;
        EXPECT_EQ(choice.own_map->kind, map.kind);
        EXPECT_EQ(choice.warning.empty(), colormap_choice(map.name).warning.empty()) << map.name;
    }
}

TEST_F(ColormapFile, JsonOfParaview) {
    const std::string points = R"("RGBPoints": [-1, 0, 0, 1, 0, 1, 1, 1, 3, 1, 0, 0], "NanColor": [1, 1, 0], "Name": "x")";
    for (const std::string& text : {"[{" + points + "}]", "{" + points + ", \"ColorSpace\": \"RGB\"}"}) {
        const std::shared_ptr<const Colormap> map = read(text).own_map;
        EXPECT_EQ(render::color_at(*map, 0.25), (Rgba{255, 255, 255, 255}));
        EXPECT_EQ(render::color_at(*map, 0.625), (Rgba{255, 128, 128, 255}));
    }
    const auto middle = [&](const char* space) {
        const std::string text = std::string(R"({"RGBPoints": [0, 0, 0, 1, 1, 1, 1, 0], "ColorSpace": ")") + space + "\"}";
        return render::lab_of(render::color_at(*read(text).own_map, 0.5));
    };
    const glm::dvec3 half = 0.5 * (render::lab_of({0, 0, 255, 255}) + render::lab_of({255, 255, 0, 255}));
    EXPECT_LT(glm::distance(middle("Lab"), half), 1);
    EXPECT_LT(glm::distance(middle("CIELAB"), half), 1);
    EXPECT_LT(glm::distance(middle("RGB"), render::lab_of({128, 128, 128, 255})), 1);
}

TEST_F(ColormapFile, IsRefusedWithItsLine) {
    const std::map<std::string, std::string> refused{
        {"", "0 colours are no colour map"},
        {"r,g,b\n", "0 colours are no colour map"},
        {"0,0,1\n", "1 colours are no colour map"},
        {"0,0,1\n1,1\n", ":2: '1,1' is not a row of 3 or 4 numbers"},
        {"0,0,1\n1,nan,1\n", ":2: '1,nan,1' is not a row"},
        {"0,nan,1\n1,1,1\n", ":1: '0,nan,1' is not a row"},
        {"0,0,1\n1,inf,1\n", ":2: "},
        {"0,0,1\n1,1,1,1\n", ":2: rows have 3 and 4 numbers"},
        {"0,0,1\n1,256,1\n", ":2: 256 is not part of a colour"},
        {"0,0,1\n1,-0.1,1\n", ":2: -0.1 is not part of a colour"},
        {"1,0,0,1\n0,1,1,1\n", ":2: 0 is below the t of the row before"},
        {"1,0,0,1\n1,1,1,1\n", ":2: t does not rise"},
        {"-1e308,0,0,1\n1e308,1,1,1\n", ":2: t does not rise"},
        {"a,b,c\nd,e,f\n0,0,0\n1,1,1\n", ":2: 'd,e,f' is not a row"},
        {std::string("0,0,1\n\0,1,1\n", 12), ":2: NUL byte"},
        {"{\n\"RGBPoints\": [0, 0\n", ":3: it is not JSON"},
        {"[]", "no colour map with a list RGBPoints"},
        {"{}", "no colour map with a list RGBPoints"},
        {R"({"RGBPoints": "x"})", "no colour map with a list RGBPoints"},
        {R"({"RGBPoints": [0, 0, 0, 0, null, 1, 1, 1]})", "no colour map with a list RGBPoints"},
        {R"({"RGBPoints": [0, 0, 0, 0, 1, 1, 1]})", "RGBPoints is not a list of x, r, g, b"},
        {R"({"ColorSpace": 3, "RGBPoints": []})", "no colour map with a list RGBPoints"},
        {R"({"ColorSpace": "HSV", "RGBPoints": [0, 0, 0, 0, 1, 1, 1, 1]})", "its ColorSpace 'hsv' is not known"},
        {std::string(5000, '['), ":1: it is not JSON"},
    };
    for (const auto& [text, words] : refused) {
        const std::string told = refusal(text);
        EXPECT_NE(told.find(words), std::string::npos) << text.substr(0, 80) << "\n" << told;
        EXPECT_TRUE(told.starts_with(file + ":")) << told;
    }
}

TEST_F(ColormapFile, HasUpTo4096Rows) {
    std::string text;
    for (int i = 0; i < 4096; ++i) text += std::to_string(i / 4096.0) + " 0 0\n";
    EXPECT_EQ(read(text).own_map->stops.size(), 4096U);
    EXPECT_NE(refusal(text + "1 0 0\n").find(":4097: more than 4096 colours"), std::string::npos);
    write_file(file, "");
    std::filesystem::resize_file(file, std::uintmax_t{20} << 30);   // a billion rows, without a byte on the disk
    EXPECT_THROW(colormap_choice(file), InputError);
}

TEST_F(ColormapFile, DamagedIsReadOrRefusedInOneLine) {
    int refused = 0, taken = 0;
    for (const char* whole : {"0,0,0,1\n1,1,0,0\n", R"({"RGBPoints":[0,0,0,1,1,1,0,0]})"})
        testing_tools::for_each_damage(whole, [&](const std::string& damaged) {
            write_file(file, damaged);
            try {
                const ColorChoice choice = colormap_choice(file);
                EXPECT_GE(choice.own_map->stops.size(), 2U);
                ++taken;
            } catch (const InputError& error) {
                EXPECT_TRUE(testing_tools::is_one_line_about(file + ":", error.what())) << error.what();
                ++refused;
            }
        });
    EXPECT_GT(refused, 100);
    EXPECT_GT(taken, 10);
}

}   // namespace
