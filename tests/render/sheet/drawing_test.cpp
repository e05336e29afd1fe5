#include "sheet/drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "render/shapes.h"
#include "sheet/strokes.h"

namespace {

using render::Drawing;
using render::Image;
using render::Rgba;

constexpr Rgba black{0, 0, 0, 255}, half_red{200, 0, 0, 128};

Drawing drawing_with(Drawing::Item item) { return {.width = 60, .height = 50, .items = {std::move(item)}}; }

/// The area of the ink of a black drawing on white [pixels].
double ink_of(const Drawing& drawing) {
    double sum = 0;
    for (const Rgba& pixel : render::painted(drawing).pixels) sum += 1 - pixel.r / 255.0;
    return sum;
}

TEST(Drawing, ARectangleFillsWholePixels) {
    for (const Rgba background : {Rgba{255, 255, 255, 255}, Rgba{0, 0, 0, 0}})
        for (const auto& [x0, y0, x1, y1] : {std::array{3, 4, 20, 11}, {-7, -2, 5, 60}, {40, 30, 99, 70}, {8, 8, 8, 20}, {70, 5, 80, 9}}) {
            Drawing drawing{.width = 60, .height = 50, .background = background};
            drawing.add_rectangle(x0, y0, x1, y1, half_red);
            Image expected(60, 50, background);
            render::fill_rectangle(expected, x0, y0, x1, y1, half_red);
            EXPECT_EQ(render::painted(drawing).pixels, expected.pixels) << x0;
        }
}

TEST(Drawing, AnAreaCoversAsManyPixelsAsItIsLarge) {
    for (int turn = 0; turn < 36; ++turn) {
        const double a = glm::radians(10.0 * turn + 3);
        const glm::dvec2 u(15 * std::cos(a), 15 * std::sin(a)), v(-0.6 * u.y, 0.6 * u.x), middle(30.3, 24.8);
        EXPECT_NEAR(ink_of(drawing_with(Drawing::Area{{middle - u, middle + v, middle + u, middle - v}, black})), 2 * 15 * 9, 0.7) << turn;
        EXPECT_NEAR(ink_of(drawing_with(Drawing::Area{{middle, middle + u, middle + v}, black})), 15 * 9 / 2.0, 0.7) << turn;
    }
    EXPECT_EQ(ink_of(drawing_with(Drawing::Area{{}, black})), 0);
    EXPECT_EQ(ink_of(drawing_with(Drawing::Area{{{3, 3}, {30, 20}}, black})), 0);
}

TEST(Drawing, AreasWithACommonSideCoverEachPixelOnce) {
    const glm::dvec2 a(5.2, 4.1), b(50.7, 9.9), c(44.4, 41.3), d(8.8, 44.6);
    const Image left = render::painted(drawing_with(Drawing::Area{{a, b, d}, black})),
                right = render::painted(drawing_with(Drawing::Area{{b, c, d}, black})),
                whole = render::painted(drawing_with(Drawing::Area{{a, b, c, d}, black}));
    for (std::size_t i = 0; i < whole.pixels.size(); ++i)
        ASSERT_NEAR(255 - left.pixels[i].r + 255 - right.pixels[i].r, 255 - whole.pixels[i].r, 1) << i;
}

TEST(Drawing, APathIsItsLinesAndARampTheColoursOfItsColumns) {
    Image lines(60, 50), columns(60, 50);
    render::draw_line(lines, {3, 4}, {40, 20}, 2.5, black);
    render::draw_line(lines, {40, 20}, {10, 45}, 2.5, black);
    EXPECT_EQ(render::painted(drawing_with(Drawing::Path{{{3, 4}, {40, 20}, {10, 45}}, 2.5, black})).pixels, lines.pixels);
    const render::Colormap& map = render::colormap_named("viridis");
    const Image ramp = render::painted(drawing_with(Drawing::Ramp{&map, 10, 5, 50, 12}));
    for (int x = 0; x < 60; ++x) {
        const Rgba expected = x < 10 || x >= 50 ? Rgba{255, 255, 255, 255} : render::color_at(map, (x - 9.5) / 40);
        EXPECT_EQ(ramp.at(x, 5), expected) << x;
        EXPECT_EQ(ramp.at(x, 11), expected) << x;
        EXPECT_EQ(ramp.at(x, 12), (Rgba{255, 255, 255, 255})) << x;
    }
}

// Each kind of item, drawn at a place or added there.
TEST(Drawing, AddedItemsAreMoved) {
    const auto picture = std::make_shared<Image>(5, 4, half_red);
    const auto all_at = [&](int x, int y) {
        const glm::dvec2 at(x, y);
        Drawing drawing{.width = 90, .height = 80};
        drawing.items = {Drawing::Picture{picture, x + 1, y + 2},
                         Drawing::Text{at + glm::dvec2(8, 30), "ab", {}},
                         Drawing::Path{{at + 3.5, at + 9.0}, 1.5, half_red},
                         Drawing::Ring{at + 20.0, 5, 2, black},
                         Drawing::Area{{at, at + glm::dvec2(9.5, 1), at + glm::dvec2(2, 12.25)}, half_red},
                         Drawing::Ramp{&render::colormap_named("viridis"), x + 20, y + 3, x + 33, y + 9}};
        return drawing;
    };
    Drawing moved{.width = 90, .height = 80};
    moved.add(all_at(2, 3), 30, 40);
    EXPECT_EQ(render::painted(moved).pixels, render::painted(all_at(32, 43)).pixels);
    for (std::size_t i = 0; i < moved.items.size(); ++i) {   // none is hidden by others or drawn outside
        Drawing one{.width = 90, .height = 80, .items = {moved.items[i]}};
        EXPECT_GT(render_tests::differing_pixels(render::painted(one), Image(90, 80)), 10) << i;
    }
}

}   // namespace
