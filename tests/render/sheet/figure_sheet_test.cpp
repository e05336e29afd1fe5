#include "sheet/figure_sheet.h"

#include <gtest/gtest.h>

#include "render/picture_box.h"

namespace {

using render::FigureSheet;
using render::Image;
using render::Rgba;
using render_tests::box_of;

constexpr Rgba red{200, 0, 0, 255}, green{0, 200, 0, 255};

FigureSheet two_pictures() {
    FigureSheet sheet{.title = "Title", .subtitle = "subtitle"};
    sheet.pictures.push_back({std::make_shared<Image>(70, 50, red), 0, 0});
    sheet.pictures.push_back({std::make_shared<Image>(30, 90, green), 100, 20});
    return sheet;
}

TEST(FigureSheet, PicturesAreWholeAndInTheirPlaces) {
    const render::SheetDrawing composed = render::drawing_of(two_pictures());
    const Image image = render::painted(composed.drawing);
    const auto first = box_of(image, red), second = box_of(image, green);
    EXPECT_TRUE(first.is_full(70, 50));
    EXPECT_TRUE(second.is_full(30, 90));
    EXPECT_EQ(first.x0, composed.left);
    EXPECT_EQ(first.y0, composed.top);
    EXPECT_EQ(second.x0 - first.x0, 100);
    EXPECT_EQ(second.y0 - first.y0, 20);
}

TEST(FigureSheet, LongWordsStayInTheirBoxesAndOffThePictures) {
    FigureSheet sheet = two_pictures();
    sheet.title = sheet.subtitle = std::string(400, 'W');
    sheet.words.push_back({std::string(90, 'v'), 0, 60, 70, 24, true});
    sheet.words.push_back({std::string(90, 'v'), 0, 90, 70, 24, false});
    const render::SheetDrawing composed = render::drawing_of(sheet);
    const Image image = render::painted(composed.drawing);
    EXPECT_TRUE(box_of(image, red).is_full(70, 50));
    EXPECT_TRUE(box_of(image, green).is_full(30, 90));
    for (int x = composed.left + 70; x < composed.left + 100; ++x)
        for (int y = composed.top + 60; y < composed.top + 114; ++y) ASSERT_EQ(image.at(x, y), (Rgba{255, 255, 255, 255})) << x << ' ' << y;
}

}   // namespace
