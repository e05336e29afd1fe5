#include "sheet/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "color/cielab.h"
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

render::SheetRow painted_row(std::string label, int width, int height) {
    render::SheetRow row{std::move(label), {}};
    for (const Rgba paint : paints) row.pictures.emplace_back(width, height, paint);
    return row;
}

ContactSheet sheet_of(int rows, int width, int height) {
    ContactSheet sheet{.title = "Title", .subtitle = "subtitle", .view_names = {"+x", "-x", "+y", "-y", "+z", "-z"}};
    for (int r = 0; r < rows; ++r) sheet.rows.push_back(painted_row(rows > 1 ? "λ = " + std::to_string(r) : "", width, height));
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
    const Image image = render::compose(sheet_of(1, 130, 110));
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
    ContactSheet sheet = sheet_of(1, 100, 100);
    sheet.view_names = {"-z", "+z", "-y", "+y", "-x", "+x"};
    const Image image = render::compose(sheet);
    EXPECT_LT(box_of(image, paints[5]).y1, box_of(image, paints[4]).y0);   // +x above −x
    EXPECT_LT(box_of(image, paints[5]).x1, box_of(image, paints[1]).x0);   // +x left of +z
}

TEST(ContactSheet, SeveralRowsHaveSixColumns) {
    const Image image = render::compose(sheet_of(3, 90, 80));
    for (std::size_t i = 0; i < 6; ++i) {
        const Box b = box_of(image, paints[i]);
        EXPECT_EQ(b.count, 3 * 90 * 80);
        EXPECT_EQ(b.x1 - b.x0 + 1, 90);
        if (i > 0) {
            EXPECT_GT(b.x0, box_of(image, paints[i - 1]).x1);
        }
    }
}

TEST(ContactSheet, CellsAreShrunkNeverEnlarged) {
    ContactSheet sheet = sheet_of(1, 130, 65);
    sheet.cell = 50;
    EXPECT_TRUE(box_of(render::compose(sheet), paints[0]).is_full(50, 25));
    sheet.cell = 500;
    EXPECT_TRUE(box_of(render::compose(sheet), paints[0]).is_full(130, 65));
}

TEST(ContactSheet, LongTextsNeitherReachTheBorderNorTheOtherParts) {
    for (const int rows : {1, 2}) {
        ContactSheet sheet = sheet_of(rows, 90, 90);
        sheet.title = std::string(400, 'W');
        sheet.subtitle = std::string(400, 'g');
        for (render::SheetRow& row : sheet.rows)
            row.label = "a label of many words that would not fit beside its row " + std::string(60, 'm');
        for (std::string& name : sheet.view_names) name = std::string(90, 'v');
        sheet.color_bar = long_bar();
        const Image image = render::compose(sheet);
        EXPECT_TRUE(border_is_empty(image, white));
        for (const Rgba paint : paints) EXPECT_EQ(box_of(image, paint).count, rows * 90 * 90);
    }
}

TEST(ContactSheet, AnyNumberOfPicturesIsComposed) {
    for (std::size_t n = 0; n <= 7; ++n) {
        ContactSheet sheet = sheet_of(1, 60, 60);
        sheet.rows[0].pictures.assign(n, Image(60, 60, paints[0]));
        sheet.view_names.assign(n, "+x");
        EXPECT_EQ(box_of(render::compose(sheet), paints[0]).count, static_cast<int>(n) * 3600);
    }
    EXPECT_GT(render::compose({}).width, 0);
}

TEST(ContactSheet, PicturesOfDifferentSizesAreRefused) {
    ContactSheet sheet = sheet_of(2, 60, 60);
    sheet.rows[1].pictures[3] = Image(60, 61);
    EXPECT_THROW(render::compose(sheet), std::invalid_argument);
}

TEST(ContactSheet, OnADarkGroundTheTextIsLight) {
    ContactSheet sheet = sheet_of(1, 90, 90);
    sheet.background = {20, 20, 24, 255};
    sheet.view_names.clear();
    const Image image = render::compose(sheet);
    const auto brightest = std::max_element(image.pixels.begin(), image.pixels.end(), [](Rgba a, Rgba b) { return a.g < b.g; });
    EXPECT_GT(brightest->g, 220);
}

// The axes keep to their hues and stand out from either ground.
TEST(ContactSheet, TripodsAreSeenOnLightAndOnDarkGround) {
    for (const Rgba ground : {white, Rgba{20, 20, 24, 255}}) {
        ContactSheet sheet = sheet_of(1, 90, 90);
        sheet.background = ground;
        for (Image& picture : sheet.rows[0].pictures) picture = Image(90, 90, ground);
        const Image image = render::compose(sheet);
        std::map<char, double> farthest;   // lightness from the ground, of reddish, greenish and bluish pixels
        for (const Rgba p : image.pixels) {
            const char hue = p.r > p.g + 50 && p.r > p.b + 50 ? 'x' : p.g > p.r + 40 && p.g > p.b + 40 ? 'y' : p.b > p.r + 50 ? 'z' : ' ';
            farthest[hue] = std::max(farthest[hue], std::abs(render::lab_of(p).x - render::lab_of(ground).x));
        }
        for (const char hue : {'x', 'y', 'z'}) EXPECT_GT(farthest[hue], 45) << hue;
    }
}

TEST(ContactSheet, RowLabelsAreBrokenIntoLinesOfAboutOneLength) {
    ContactSheet sheet = sheet_of(2, 90, 90);
    sheet.view_names.clear();
    sheet.rows[0].label = sheet.rows[1].label = "nnnnnn nnnnnn nn nnn";   // "nn" would fit into the first line of two
    const Image image = render::compose(sheet);
    const int first_picture = box_of(image, paints[0]).x0;
    sheet.rows[0].label = sheet.rows[1].label = "nnnnnn nnnnnn";
    EXPECT_EQ(first_picture, box_of(render::compose(sheet), paints[0]).x0);
}

// Wide enough for "λ = 0.1, 20" would do for the two lines, but not for the reader.
TEST(ContactSheet, NumbersStayWithTheirWords) {
    ContactSheet sheet = sheet_of(2, 90, 90);
    sheet.view_names.clear();
    const auto left_of_pictures = [&](const char* label) {
        sheet.rows[0].label = sheet.rows[1].label = label;
        return box_of(render::compose(sheet), paints[0]).x0;
    };
    EXPECT_EQ(left_of_pictures("λ = 0.1, 20 iterations"), left_of_pictures("20 iterations"));
    EXPECT_EQ(left_of_pictures("uniformly λ = 0.0001"), std::max(left_of_pictures("uniformly"), left_of_pictures("λ = 0.0001")));
    EXPECT_LT(left_of_pictures("20 quiteunbrokeniterations"), left_of_pictures("quiteunbrokeniterations") + 40);
}

}   // namespace
