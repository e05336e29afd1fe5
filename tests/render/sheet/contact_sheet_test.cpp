#include "sheet/figure_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "color/srgb.h"
#include "render/picture_box.h"

namespace {

using render::ContactSheet;
using render::Image;
using render::Rgba;
using render_tests::Box;
using render_tests::box_of;
using render_tests::long_bar;
using render_tests::white;

constexpr std::array<Rgba, 6> paints{
    {{200, 0, 0, 255}, {100, 0, 0, 255}, {0, 200, 0, 255}, {0, 100, 0, 255}, {0, 0, 200, 255}, {0, 0, 100, 255}}};

ContactSheet sheet_of(int width, int height) {
    ContactSheet sheet{.title = "Title", .subtitle = "subtitle", .view_names = {"+x", "-x", "+y", "-y", "+z", "-z"}};
    for (const Rgba paint : paints) sheet.pictures.emplace_back(width, height, paint);
    return sheet;
}

bool border_is_empty(const Image& image, Rgba background) {
    for (int x = 0; x < image.width; ++x)
        if (image.at(x, 0) != background || image.at(x, image.height - 1) != background) return false;
    for (int y = 0; y < image.height; ++y)
        if (image.at(0, y) != background || image.at(image.width - 1, y) != background) return false;
    return true;
}

TEST(ContactSheet, SixViewsStandTwoByThree) {
    const Image image = render::compose(sheet_of(130, 110));
    std::array<Box, 6> box;
    for (std::size_t i = 0; i < 6; ++i) {
        box[i] = box_of(image, paints[i]);
        EXPECT_TRUE(box[i].is_full(130, 110)) << i;   // whole, and nothing drawn over it
    }
    // +x +y +z over −x −y −z
    EXPECT_EQ(box[0].y0, box[2].y0);
    EXPECT_EQ(box[2].y0, box[4].y0);
    EXPECT_LT(box[0].x1, box[2].x0);
    EXPECT_LT(box[2].x1, box[4].x0);
    for (const std::size_t i : {0, 2, 4}) {
        EXPECT_EQ(box[i].x0, box[i + 1].x0);
        EXPECT_LT(box[i].y1, box[i + 1].y0);
    }
}

TEST(ContactSheet, SixViewsAreOrderedByTheirNames) {
    ContactSheet sheet = sheet_of(100, 100);
    sheet.view_names = {"-z", "+z", "-y", "+y", "-x", "+x"};
    const Image image = render::compose(sheet);
    EXPECT_LT(box_of(image, paints[5]).y1, box_of(image, paints[4]).y0);   // +x above −x
    EXPECT_LT(box_of(image, paints[5]).x1, box_of(image, paints[1]).x0);   // +x left of +z
}

TEST(ContactSheet, CellsAreShrunkNeverEnlarged) {
    ContactSheet sheet = sheet_of(130, 65);
    sheet.cell = 50;
    EXPECT_TRUE(box_of(render::compose(sheet), paints[0]).is_full(50, 25));
    sheet.cell = 500;
    EXPECT_TRUE(box_of(render::compose(sheet), paints[0]).is_full(130, 65));
}

TEST(ContactSheet, LongTextsNeitherReachTheBorderNorTheOtherParts) {
    ContactSheet sheet = sheet_of(90, 90);
    sheet.title = std::string(400, 'W');
    sheet.subtitle = std::string(400, 'g');
    for (std::string& name : sheet.view_names) name = std::string(90, 'v');
    sheet.color_bar = long_bar();
    const Image image = render::compose(sheet);
    EXPECT_TRUE(border_is_empty(image, white));
    for (const Rgba paint : paints) EXPECT_EQ(box_of(image, paint).count, 90 * 90);
}

TEST(ContactSheet, AnyNumberOfPicturesIsComposed) {
    for (std::size_t n = 0; n <= 7; ++n) {
        ContactSheet sheet = sheet_of(60, 60);
        sheet.pictures.assign(n, Image(60, 60, paints[0]));
        sheet.view_names.assign(n, "+x");
        EXPECT_EQ(box_of(render::compose(sheet), paints[0]).count, static_cast<int>(n) * 3600);
    }
    EXPECT_GT(render::compose(ContactSheet()).width, 0);
}

TEST(ContactSheet, PicturesOfDifferentSizesAreRefused) {
    ContactSheet sheet = sheet_of(60, 60);
    sheet.pictures[3] = Image(60, 61);
    EXPECT_THROW(render::compose(sheet), std::invalid_argument);
}

TEST(ContactSheet, OnADarkGroundTheTextIsLight) {
    ContactSheet sheet = sheet_of(90, 90);
    sheet.background = {20, 20, 24, 255};
    sheet.view_names.clear();
    const Image image = render::compose(sheet);
    const auto brightest = std::max_element(image.pixels.begin(), image.pixels.end(), [](Rgba a, Rgba b) { return a.g < b.g; });
    EXPECT_GT(brightest->g, 220);
}

// The axes keep to their hues and stand out from either ground.
TEST(ContactSheet, TripodsAreSeenOnLightAndOnDarkGround) {
    for (const Rgba ground : {white, Rgba{20, 20, 24, 255}}) {
        ContactSheet sheet = sheet_of(90, 90);
        sheet.background = ground;
        for (Image& picture : sheet.pictures) picture = Image(90, 90, ground);
        const Image image = render::compose(sheet);
        std::map<char, double> farthest;   // lightness from the ground, of reddish, greenish and bluish pixels
        for (const Rgba p : image.pixels) {
            const char hue = p.r > p.g + 50 && p.r > p.b + 50 ? 'x' : p.g > p.r + 40 && p.g > p.b + 40 ? 'y' : p.b > p.r + 50 ? 'z' : ' ';
            farthest[hue] = std::max(farthest[hue], std::abs(render::lab_of(p).x - render::lab_of(ground).x));
        }
        for (const char hue : {'x', 'y', 'z'}) EXPECT_GT(farthest[hue], 45) << hue;
    }
}

}   // namespace
