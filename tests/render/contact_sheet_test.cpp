#include "contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "cielab.h"
#include "color_bar.h"
#include "ticks.h"

namespace {

using render::ContactSheet;
using render::Image;
using render::Rgba;

constexpr Rgba white{255, 255, 255, 255};
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

struct Box {
    int x0 = 1 << 20, x1 = -1, y0 = 1 << 20, y1 = -1, count = 0;
    bool is_full(int width, int height) const { return x1 - x0 + 1 == width && y1 - y0 + 1 == height && count == width * height; }
};

Box box_of(const Image& image, Rgba color) {
    Box b;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y) == color) b = {std::min(b.x0, x), std::max(b.x1, x), std::min(b.y0, y), std::max(b.y1, y), b.count + 1};
    return b;
}

bool border_is_empty(const Image& image, Rgba background) {
    for (int x = 0; x < image.width; ++x)
        if (image.at(x, 0) != background || image.at(x, image.height - 1) != background) return false;
    for (int y = 0; y < image.height; ++y)
        if (image.at(0, y) != background || image.at(image.width - 1, y) != background) return false;
    return true;
}

render::ColorBar long_bar() {
    return {{&render::colormap_named("viridis"), -1234.5, 6543.2}, std::string(300, 'q'), "some unit", 0.123, 0.0456, true};
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

// ---- colour bar -----------------------------------------------------------------------------------------------------

Image bar_image(const render::ColorBar& bar, int width) {
    Image image(width, render::color_bar_height(bar, 16) + 10);
    render::draw_color_bar(image, bar, 10, 5, width - 20, 16, {0, 0, 0, 255});
    return image;
}

TEST(ColorBar, ShowsTheWholeMapFromLowToHigh) {
    const render::ColorBar bar{{&render::colormap_named("viridis"), 0, 1}, "H", ""};
    const Image image = bar_image(bar, 700);
    std::vector<Rgba> row;
    for (int y = 0; y < image.height && row.empty(); ++y)
        if (image.at(350, y) == render::color_at(*bar.range.colormap, 0.5))
            for (int x = 0; x < image.width; ++x)
                if (image.at(x, y + 4) != white) row.push_back(image.at(x, y + 4));
    ASSERT_GT(row.size(), 300U);
    for (std::size_t i = 0; i < row.size(); ++i) {
        const Rgba expected = render::color_at(*bar.range.colormap, (static_cast<double>(i) + 0.5) / static_cast<double>(row.size()));
        ASSERT_NEAR(row[i].g, expected.g, 1);
        ASSERT_NEAR(row[i].r, expected.r, 1);
    }
}

TEST(ColorBar, ClippedAndUndefinedSharesAreShown) {
    render::ColorBar bar{{&render::colormap_named("viridis"), 0, 1}, "H", ""};
    const Image without = bar_image(bar, 700);
    bar.clipped_below = 0.02;
    const Image below = bar_image(bar, 700);
    bar.clipped_below = 0;
    bar.has_undefined = true;
    const Image undefined = bar_image(bar, 700);
    EXPECT_GT(below.height, without.height);
    EXPECT_GT(box_of(undefined, bar.undefined_color).count, 40);
    EXPECT_EQ(box_of(below, bar.undefined_color).count, 0);
    // the tip below the range has the colour of its low end, left of the bar
    EXPECT_LT(box_of(below, render::color_at(*bar.range.colormap, 0)).x0, box_of(without, render::color_at(*bar.range.colormap, 0)).x0 - 3);
}

/// The rows of `image` from `first` on, as many as `rows`.
std::vector<Rgba> rows_of(const Image& image, int first, int rows) {
    const auto at = [&](int row) { return image.pixels.begin() + static_cast<std::ptrdiff_t>(row) * image.width; };
    return {at(first), at(first + rows)};
}

TEST(ColorBar, TheHistogramPushesTheBarDownAndChangesNothingElse) {
    render::ColorBar bar = long_bar();
    const Image without = bar_image(bar, 700);
    bar.histogram.assign(96, 0.01);
    const Image with = bar_image(bar, 700);
    const int higher = with.height - without.height, title = 5 + 22;
    EXPECT_GT(higher, 16);
    EXPECT_EQ(rows_of(with, 0, title), rows_of(without, 0, title));
    EXPECT_EQ(rows_of(with, title + higher + 2, without.height - title - 2), rows_of(without, title + 2, without.height - title - 2));
    for (const std::vector<double>& nothing : {std::vector<double>{}, std::vector<double>(96, 0.0), {std::nan(""), -1, INFINITY}}) {
        bar.histogram = nothing;
        EXPECT_EQ(bar_image(bar, 700).pixels, without.pixels);
    }
}

// Ink above the bar in each column, in pixels.
TEST(ColorBar, EachBinStandsOverItsValuesWithTheRootOfItsShare) {
    render::ColorBar bar{{&render::colormap_named("grey"), 0, 1}, "", ""};
    bar.histogram.assign(8, 0);
    bar.histogram[2] = 0.25, bar.histogram[6] = 0.01;
    const Image image = bar_image(bar, 700);
    const Box colors = box_of(image, render::color_at(*bar.range.colormap, 0.5 / 600));
    const auto height_over = [&](double t) {
        const int x = colors.x0 + static_cast<int>(t * (700 - 2 * colors.x0));
        int top = colors.y0;
        for (int y = colors.y0 - 1; y > 24; --y)
            if (image.at(x, y).r < 225) top = y;
        return colors.y0 - top;
    };
    EXPECT_GT(height_over(2.5 / 8), 20);
    EXPECT_NEAR(height_over(6.5 / 8), 0.2 * height_over(2.5 / 8), 3);
    EXPECT_NEAR(height_over(2 / 8.0), 0.5 * height_over(2.5 / 8), 3);
    for (const double t : {0.1, 0.45, 0.7, 0.99}) EXPECT_LE(height_over(t), 3) << t;
}

TEST(ColorBar, NarrowBarsAndStrangeRangesAreDrawn) {
    const double nan = std::nan(""), huge = 1.7e308;
    for (const int width : {40, 120, 900})
        for (const auto& [low, high] : {std::pair{0.0, 0.0}, {nan, nan}, {-huge, huge}, {1e15, 1e15 + 1}, {1e-300, 2e-300}, {1.0, 0.0}}) {
            render::ColorBar bar = long_bar();
            bar.range.low = low, bar.range.high = high;
            bar.histogram = {0.1, 0.3, 0.2};
            EXPECT_EQ(bar_image(bar, width).width, width);
        }
}

// ---- ticks ----------------------------------------------------------------------------------------------------------

TEST(RoundTicks, AreRoundInsideEquallySpacedAndAboutAsManyAsWanted) {
    for (const auto& [low, high] :
         {std::pair{0.0, 1.0}, {-0.73, 0.73}, {-3e-9, 1.7e-8}, {1e30, 9.3e30}, {99.0, 101.5}, {-1234.5, 6543.2}, {0.1, 0.3}})
        for (const int wanted : {3, 5, 7}) {
            const std::vector<double> ticks = render::round_ticks(low, high, wanted);
            ASSERT_GE(ticks.size(), 2U) << low << " " << high;
            EXPECT_NEAR(static_cast<double>(ticks.size()), wanted, 2) << low << " " << high;
            EXPECT_GE(ticks.front(), low);
            EXPECT_LE(ticks.back(), high);
            const double step = ticks[1] - ticks[0];
            for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_NEAR(ticks[i] - ticks[i - 1], step, 1e-9 * step);
            EXPECT_LT(ticks.front() - low, step);
            EXPECT_LT(high - ticks.back(), step);
            const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
            const bool round =
                std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 2.5), std::abs(mantissa - 5)}) < 1e-6;
            EXPECT_TRUE(round) << mantissa;
        }
}

TEST(RoundTicks, ContainZeroExactlyWhenTheRangeDoes) {
    const std::vector<double> ticks = render::round_ticks(-0.3, 0.3, 7);
    EXPECT_EQ(std::count(ticks.begin(), ticks.end(), 0.0), 1);
    EXPECT_EQ(std::count(ticks.begin(), ticks.end(), 0.1), 1);   // the double nearest to 0.1, not 3 × 0.0333…
}

TEST(RoundTicks, NoRangeNoTicks) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(render::round_ticks(1, 1, 5).empty());
    EXPECT_TRUE(render::round_ticks(2, 1, 5).empty());
    EXPECT_TRUE(render::round_ticks(std::nan(""), 1, 5).empty());
    EXPECT_TRUE(render::round_ticks(-infinity, infinity, 5).empty());
}

TEST(TickLabels, AllHaveTheSameDecimals) {
    EXPECT_EQ(render::tick_labels({-0.5, -0.25, 0, 0.25}).text, (std::vector<std::string>{"\u22120.50", "\u22120.25", "0.00", "0.25"}));
    EXPECT_EQ(render::tick_labels({0, 200, 400}).text, (std::vector<std::string>{"0", "200", "400"}));
}

TEST(TickLabels, SmallAndLargeNumbersShareAPowerOfTen) {
    const render::TickLabels small = render::tick_labels({0, 5e-9, 1e-8, 1.5e-8});
    EXPECT_EQ(small.power, "10⁻⁸");
    EXPECT_EQ(small.text, (std::vector<std::string>{"0.0", "0.5", "1.0", "1.5"}));
    EXPECT_EQ(render::tick_labels({1e30, 2e30}).power, "10³⁰");
    EXPECT_EQ(render::tick_labels({1000, 2000}).power, "");
}

TEST(ShareText, IsShort) {
    EXPECT_EQ(render::share_text(0.0193), "1.9\u202f%");
    EXPECT_EQ(render::share_text(0.25), "25\u202f%");
    EXPECT_EQ(render::share_text(1e-9), "<\u202f0.1\u202f%");
}

}   // namespace
