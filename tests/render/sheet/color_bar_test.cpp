#include "sheet/color_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/picture_box.h"
#include "sheet/ticks.h"

namespace {

using render::Image;
using render::Rgba;
using render_tests::Box;
using render_tests::box_of;
using render_tests::long_bar;
using render_tests::white;

render::Drawing bar_drawing(const render::ColorBar& bar, int width, double em = 16) {
    render::Drawing drawing{.width = width, .height = render::color_bar_height(bar, em) + 10};
    render::add_color_bar(drawing, bar, 10, 5, width - 20, em, {0, 0, 0, 255});
    return drawing;
}

Image bar_image(const render::ColorBar& bar, int width) { return render::painted(bar_drawing(bar, width)); }

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
    bar.undefined_color = {225, 190, 231, 255};   // no grey of a letter's edge
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
    for (const double t : {2.05, 2.95}) EXPECT_NEAR(height_over(t / 8), height_over(2.5 / 8), 1) << "a column, and no triangle";
    for (const double t : {1.95 / 8, 3.05 / 8, 0.1, 0.45, 0.7, 0.99}) EXPECT_LE(height_over(t), 3) << t;
}

TEST(ColorBar, AMirroredHistogramIsDrawnMirrored) {
    render::ColorBar bar{{&render::colormap_named("grey"), 0, 1}, "", ""};
    bar.histogram = {0.02, 0.3, 0.05, 0, 0.2, 0.1, 0.01, 0.15};
    const Image image = bar_image(bar, 700);
    std::reverse(bar.histogram.begin(), bar.histogram.end());
    const Image mirrored = bar_image(bar, 700);
    const Box colors = box_of(image, render::color_at(*bar.range.colormap, 0.5 / 600));
    int largest = 0;
    for (int y = 24; y < colors.y0 - 1; ++y)
        for (int x = colors.x0 + 2; x < 700 - colors.x0 - 2; ++x)
            largest = std::max(largest, std::abs(image.at(x, y).r - mirrored.at(699 - x, y).r));
    EXPECT_LE(largest, 1);
}

TEST(ColorBar, IsolinesAreInTheBarWhereTheyAreInThePictures) {
    render::ColorBar bar{{&render::colormap_named("viridis"), -1, 1}, "H", ""};
    const Rgba ink{34, 34, 40, 255};
    const int without = box_of(bar_image(bar, 700), ink).count;
    bar.isoline_spacing = 0.5;
    const int three = box_of(bar_image(bar, 700), ink).count - without;   // −0.5, 0, 0.5: the ends are edges
    bar.isoline_spacing = 2;
    const int one = box_of(bar_image(bar, 700), ink).count - without;
    EXPECT_GT(one, 8);
    EXPECT_EQ(three, 3 * one);
}

// A small bar has the ends with their unit, and the colours between.
TEST(SmallBar, ShowsTheWholeMapAndIsAsWideAsItSays) {
    render::ColorBar bar{{&render::colormap_named("diverging"), -7.21, 7.21}, "H", "% of h̄"};
    render::Drawing drawing{.width = 600, .height = 40};
    render::add_small_bar(drawing, bar, 10, 20, 16, {0, 0, 0, 255});
    const Image image = render::painted(drawing);
    const Box low = box_of(image, render::color_at(*bar.range.colormap, 0.5 / 112)), all = box_of(image, white);
    EXPECT_GT(low.count, 5);
    EXPECT_GT(low.x0, 10 + 20) << "its low end is a number";
    int last = 0;
    for (int x = 0; x < image.width; ++x)
        for (int y = 0; y < image.height; ++y)
            if (image.at(x, y) != white) last = x;
    EXPECT_NEAR(last, 10 + render::small_bar_width(bar, 16), 3);
    EXPECT_EQ(all.x0, 0);
    const double without = render::small_bar_width(bar, 16);
    bar.clipped_above = 0.03;
    EXPECT_GT(render::small_bar_width(bar, 16), without) << "the share beyond is said";
}

TEST(NumberText, HasThreeDigitsAtMost) {
    for (const auto& [x, text] : {std::pair{7.2135, "7.21"}, {-7.2, "\u22127.2"}, {0.0, "0"}, {0.05, "0.05"}, {12345.0, "12\u202f300"}})
        EXPECT_EQ(render::number_text(x), text);
    EXPECT_EQ(render::number_text(2.5e-7), "2.5\u202f×\u202f10⁻⁷");
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

/// The ends of a text from left to right.
std::pair<double, double> extent_of(const render::Drawing::Text& text) {
    const double width = render::text_width(text.text, text.style);
    const double left = text.at.x - width * (text.style.align == render::Align::centre ? 0.5 : text.style.align == render::Align::right);
    return {left, left + width};
}

TEST(ColorBar, WordsNeitherTouchNorLeaveTheDrawingAtAnySize) {
    const render::ValueRange plain{nullptr, -1234.5, 6543.2}, tiny{nullptr, -3e-9, 1.7e-8}, decades{nullptr, 0.02, 31, true},
        many_decades{nullptr, 1e-9, 1e3, true};
    for (const render::ValueRange& range : {plain, tiny, decades, many_decades})
        for (const double em : {7.0, 16.0, 41.0})
            for (const int width : {90, 160, 250, 400, 700, 1500}) {
                render::ColorBar bar{range, "mean curvature", "1/length", 0.123, 0.0004};
                bar.has_undefined = width % 100 == 0;
                std::vector<std::pair<double, std::pair<double, double>>> words;   // baseline, ends
                for (const auto& item : bar_drawing(bar, width, em).items)
                    if (const auto* text = std::get_if<render::Drawing::Text>(&item)) words.push_back({text->at.y, extent_of(*text)});
                std::ranges::sort(words);
                for (std::size_t i = 0; i < words.size(); ++i) {
                    const auto [left, right] = words[i].second;
                    EXPECT_TRUE(right - left > width || (left > -0.01 && right < width + 0.01)) << em << ' ' << width;
                    if (i > 0 && words[i - 1].first == words[i].first) {
                        EXPECT_GT(left, words[i - 1].second.second) << em << ' ' << width;
                    }
                }
            }
}

TEST(ColorBar, ANarrowTitleKeepsItsUnit) {
    const render::ColorBar bar{{nullptr, 0, 1}, "absolute mean curvature", "1/length"};
    const auto items = bar_drawing(bar, 190).items;
    const auto& title = std::get<render::Drawing::Text>(items.front()).text;
    EXPECT_TRUE(title.starts_with("abs") && title.ends_with("…  [1/length]")) << title;
}

// ---- ticks ----------------------------------------------------------------------------------------------------------

TEST(RoundTicks, AreRoundAndEquallySpacedAndAboutAsManyAsWanted) {
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

TEST(RoundTicks, AnEmptyRangeHasNoTicks) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(render::round_ticks(1, 1, 5).empty());
    EXPECT_TRUE(render::round_ticks(2, 1, 5).empty());
    EXPECT_TRUE(render::round_ticks(std::nan(""), 1, 5).empty());
    EXPECT_TRUE(render::round_ticks(-infinity, infinity, 5).empty());
}

void expect_near(const std::vector<double>& ticks, const std::vector<double>& expected) {
    ASSERT_EQ(ticks.size(), expected.size());
    for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_NEAR(ticks[i], expected[i], 1e-12 * expected[i]);
}

TEST(DecadeTicks, AreOneTwoAndFiveTimesPowersOfTenWhereTheyAreFew) {
    expect_near(render::decade_ticks(0.1, 20), {0.1, 0.2, 0.5, 1, 2, 5, 10, 20});
    expect_near(render::decade_ticks(0.3, 4), {0.5, 1, 2});
    expect_near(render::decade_ticks(1e-3, 1e3), {1e-3, 1e-2, 1e-1, 1, 10, 100, 1e3});
}

TEST(ValueRange, EqualRatiosAreEquallyFarApartOnALogarithmicScale) {
    const render::ValueRange range{nullptr, 0.1, 10, true};
    EXPECT_NEAR(range.position(0.1), 0, 1e-12);
    EXPECT_NEAR(range.position(1), 0.5, 1e-12);
    EXPECT_NEAR(range.position(100), 1.5, 1e-12);
    EXPECT_EQ(range.position(0), 0) << "an exact vertex is as pale as can be";
    EXPECT_NEAR((render::ValueRange{nullptr, 1, 5}.position(2)), 0.25, 1e-12);
}

TEST(TickLabels, AllHaveTheSameDecimals) {
    EXPECT_EQ(render::tick_labels({-0.5, -0.25, 0, 0.25}).text, (std::vector<std::string>{"\u22120.50", "\u22120.25", "0.00", "0.25"}));
    EXPECT_EQ(render::tick_labels({0, 200, 400}).text, (std::vector<std::string>{"0", "200", "400"}));
    EXPECT_EQ(render::tick_labels({0}).text, std::vector<std::string>{"0"});
}

TEST(TickLabels, SmallAndLargeNumbersShareAPowerOfTen) {
    const render::TickLabels small = render::tick_labels({0, 5e-9, 1e-8, 1.5e-8});
    EXPECT_EQ(small.power, "10⁻⁸");
    EXPECT_EQ(small.text, (std::vector<std::string>{"0.0", "0.5", "1.0", "1.5"}));
    EXPECT_EQ(render::tick_labels({1e30, 2e30}).power, "10³⁰");
    EXPECT_EQ(render::tick_labels({1000, 2000}).power, "");
    EXPECT_EQ(render::tick_labels({0, 20000, 40000}).text.back(), "40\u202f000") << "below 100 000 in plain";
    EXPECT_EQ(render::tick_labels({0, 100000}).power, "10⁵");
    EXPECT_EQ(render::tick_labels({0, 0.001}).power, "") << "from a thousandth in plain";
    EXPECT_EQ(render::tick_labels({0, 0.0005}).power, "10⁻⁴");
}

TEST(ShareText, IsShort) {
    EXPECT_EQ(render::share_text(0.0193), "1.9\u202f%");
    EXPECT_EQ(render::share_text(0.25), "25\u202f%");
    EXPECT_EQ(render::share_text(1e-9), "<\u202f0.1\u202f%");
}

}   // namespace
