#include "sheet/grid_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "render/shapes.h"

namespace {

using render::FontLines;
using render::GridFit;
using render::HorizontalEdge;

constexpr FontLines lines{-426, 1120, 1493, 1556, 29};

bool is_whole(double pixels) { return std::abs(pixels - std::round(pixels)) < 1e-9; }

/// Bars at random heights, as bottom and top edges.
std::vector<HorizontalEdge> random_bars(std::mt19937_64& random) {
    std::vector<HorizontalEdge> edges;
    for (std::int64_t n = render_tests::random_integer(random, 0, 5); n > 0; --n) {
        const auto bottom = static_cast<double>(render_tests::random_integer(random, -500, 1500));
        edges.push_back({bottom, false});
        edges.push_back({bottom + static_cast<double>(render_tests::random_integer(random, 20, 400)), true});
    }
    return edges;
}

TEST(GridFit, LinesFallOnRowsAndSmallSizesLoseTheOvershoot) {
    for (double size = 9; size < 40; size += 0.3) {
        const GridFit fit(lines, {}, size / 2384);
        for (const double height : {lines.descender, 0.0, lines.x_height, lines.capital, lines.ascender}) {
            EXPECT_TRUE(is_whole(fit(height))) << height;
            EXPECT_NEAR(fit(height), height * size / 2384, 0.5) << height;
        }
        EXPECT_EQ(fit(lines.x_height + lines.overshoot), fit(lines.x_height));
        EXPECT_EQ(fit(-lines.overshoot), 0);
    }
    const GridFit large(lines, {}, 100.0 / 2384);
    EXPECT_EQ(large(lines.x_height + lines.overshoot), large(lines.x_height) + 1);
}

TEST(GridFit, ABarBeginsOrEndsWithARowAndThinBarsAreOnePixelThick) {
    for (double size = 10; size < 30; size += 0.3)
        for (double bottom = 100; bottom < 900; bottom += 37) {
            const std::vector<HorizontalEdge> bar{{bottom, false}, {bottom + 140, true}};
            const GridFit fit(lines, bar, size / 2384);
            EXPECT_TRUE(is_whole(fit(bottom)) || is_whole(fit(bottom + 140))) << bottom;
            EXPECT_NEAR(fit(bottom + 140) - fit(bottom), 140 * size / 2384 < 1.4 ? 1 : 140 * size / 2384, 1e-9) << bottom;
            EXPECT_NEAR(fit(bottom + 70), (bottom + 70) * size / 2384, 1.01) << bottom;
        }
}

TEST(GridFit, IsMonotonicAndMovesLittleForAnyEdges) {
    std::mt19937_64 random(7);
    for (int trial = 0; trial < 2000; ++trial) {
        const double scale = static_cast<double>(render_tests::random_integer(random, 5, 60)) / 2384;
        const GridFit fit(lines, random_bars(random), scale);
        double previous = fit(-700);
        for (double height = -690; height < 2100; height += 10) {
            ASSERT_GE(fit(height), previous) << height;
            ASSERT_NEAR(fit(height), height * scale, 1.6) << height;
            previous = fit(height);
        }
    }
}

}   // namespace
