#include "raster/rasterizer.h"

#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "raster/tile_lists.h"
#include "render/raster/coverage_reference.h"
#include "render/shapes.h"

namespace {

using namespace render_tests;

void expect_exact(const Triangle2& t) {
    for (const int samples : {1, 4, 16}) {
        ASSERT_EQ(disagreements(t, drawn({t}, samples)), 0) << samples << " samples";
        ASSERT_EQ(disagreements(t, drawn_wide({t}, samples)), 0) << samples << " samples, slow path";
    }
}

/// Corners at random in ±`reach` round the middle of the tile, on multiples of `step`.
Triangle2 random_triangle(std::mt19937_64& random, std::int64_t reach, std::int64_t step) {
    Triangle2 t;
    for (ScreenPoint& p : t.corner) {
        p.x = left + side / 2 + step * random_integer(random, -reach / step, reach / step);
        p.y = top + side / 2 + step * random_integer(random, -reach / step, reach / step);
        p.depth = static_cast<double>(random_integer(random, -25600, 25600));
    }
    return t;
}

void expect_exact(std::int64_t reach, std::int64_t step, int count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (int i = 0; i < count; ++i) {
        ASSERT_NO_FATAL_FAILURE(expect_exact(random_triangle(random, reach, step))) << "triangle " << i;
    }
}

TEST(Rasterizer, CoverageEqualsTheExactReferenceForRandomTriangles) {
    for (const int pixels : {1, 4, 12, 31, 60}) expect_exact(pixels * 256, 1, 120, static_cast<std::uint64_t>(pixels));
}

// Corners on multiples of 32/256 pixel: many samples lie exactly on edges and corners.
TEST(Rasterizer, CoverageIsExactWhereSamplesLieOnEdges) { expect_exact(20 * 256, 32, 400, 2); }

// Just below and just above the size from which on triangles take the slow path.
TEST(Rasterizer, CoverageIsExactWhereThePathsMeet) {
    std::mt19937_64 random(9);
    for (int i = 0; i < 200; ++i) {
        Triangle2 t = random_triangle(random, 20 * 256, 1);
        t.corner[1].x = t.corner[0].x + 63 * 256 + random_integer(random, -1, 1);
        ASSERT_NO_FATAL_FAILURE(expect_exact(t)) << "triangle " << i;
    }
}

TEST(Rasterizer, CoverageIsExactForTrianglesOfAFewSubpixels) {
    std::mt19937_64 random(3);
    int covered = 0;
    for (int i = 0; i < 600; ++i) {
        const ScreenPoint sample{left + 128 + 256 * 9, top + 128 + 256 * 11, 0};
        Triangle2 t;
        for (ScreenPoint& p : t.corner) p = {sample.x + random_integer(random, -3, 3), sample.y + random_integer(random, -3, 3), 1};
        covered += covers(t, sample.x, sample.y) ? 1 : 0;
        ASSERT_NO_FATAL_FAILURE(expect_exact(t)) << "triangle " << i;
    }
    EXPECT_GT(covered, 60);   // however small, a triangle is drawn where it covers a sample
}

TEST(Rasterizer, CoverageIsExactForSlivers) {
    std::mt19937_64 random(4);
    for (int i = 0; i < 400; ++i) {
        Triangle2 t = random_triangle(random, 24 * 256, 1);
        const ScreenPoint &a = t.corner[0], &b = t.corner[1];
        t.corner[2] = {(a.x + 2 * b.x) / 3 + random_integer(random, -1, 1), (a.y + 2 * b.y) / 3 + random_integer(random, -1, 1), 0};
        ASSERT_NO_FATAL_FAILURE(expect_exact(t)) << "triangle " << i;
    }
}

// A model's coordinates are doubles: from 2⁴⁴ on their differences are no longer whole grid steps, so only the slow path is asked.
TEST(Rasterizer, CoverageIsExactForHugeTriangles) {
    for (const int bits : {18, 20, 23, 24, 28, 40}) expect_exact(std::int64_t{1} << bits, 1, 60, static_cast<std::uint64_t>(bits));
    std::mt19937_64 random(51);
    for (int i = 0; i < 60; ++i) {
        const Triangle2 t = random_triangle(random, std::int64_t{1} << 51, 1);
        ASSERT_EQ(disagreements(t, drawn_wide({t}, 4)), 0) << "triangle " << i;
    }
}

TEST(Rasterizer, TrianglesBeyondTheLimitAndDegenerateOnesCoverNothing) {
    const std::int64_t far = 2 * render::largest_coordinate;
    const std::vector<Triangle2> none{{{{{-far, -far, 0}, {far, -far, 0}, {0, far, 0}}}},
                                      {{{{left, top, 0}, {left + 2560, top + 2560, 0}, {left + 5120, top + 5120, 0}}}},
                                      {{{{left + 128, top + 128, 0}, {left + 128, top + 128, 0}, {left + 128, top + 128, 0}}}}};
    for (const SampleTile& tile : {drawn(none, 4), drawn_wide(none, 4)})
        for_each_sample(tile, [](const Sample& s) { ASSERT_TRUE(s.top == render::no_triangle && s.bottom == render::no_triangle); });
}

// A jittered triangulation of more than the tile, some of its corners on samples.
TEST(Rasterizer, TrianglesThatShareEdgesCoverEachSampleOnce) {
    std::mt19937_64 random(5);
    for (int round = 0; round < 8; ++round) {
        constexpr int n = 16;
        constexpr std::int64_t cell = 5 * 256;
        std::vector<ScreenPoint> points;
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const bool on_sample = random_integer(random, 0, 2) == 0;
                const std::int64_t jx = on_sample ? 128 : random_integer(random, -400, 400),
                                   jy = on_sample ? 128 : random_integer(random, -400, 400);
                points.push_back({left + cell * (i - 1) + jx, top + cell * (j - 1) + jy, static_cast<double>(i + j)});
            }
        std::vector<int> hits;
        const auto hit = [&](int a, int b, int c) {
            const auto p = [&](int i) { return points[static_cast<std::size_t>(i)]; };
            std::size_t i = 0;
            for_each_sample(drawn({{{{p(a), p(b), p(c)}}}}, 4), [&](const Sample& s) {
                if (i == hits.size()) hits.push_back(0);
                hits[i++] += s.top == 0 ? 1 : 0;
            });
        };
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
                const bool flipped = random_integer(random, 0, 1) == 0;   // either winding, either diagonal
                hit(a, b, flipped ? c : d);
                flipped ? hit(d, b, c) : hit(c, a, d);
            }
        ASSERT_EQ(std::count(hits.begin(), hits.end(), 1), static_cast<long>(hits.size())) << "round " << round;
    }
}

TEST(Rasterizer, TheHighestAndTheLowestTriangleAreSeenWhateverTheOrder) {
    for (const std::int64_t size : {4000, 40000}) {
        const auto at = [&](double depth) {
            return Triangle2{{{{left, top, depth}, {left + size, top, depth}, {left, top + size, depth}}}};
        };
        std::vector<double> depths{-500, 0, 500};
        do {
            std::vector<Triangle2> triangles;
            for (const double depth : depths) triangles.push_back(at(depth));
            const SampleTile tile = drawn(triangles, 4);
            EXPECT_EQ(depths[static_cast<std::size_t>(tile.row(2)[3].top[5])], 500);
            EXPECT_EQ(depths[static_cast<std::size_t>(tile.row(2)[3].bottom[5])], -500);
        } while (std::next_permutation(depths.begin(), depths.end()));
    }
}

TEST(Rasterizer, OfDoubledTrianglesTheFirstIsSeenWhateverTheOrderOfTheirCorners) {
    std::mt19937_64 random(6);
    for (const std::int64_t reach : {2 * 256, 20 * 256, 200 * 256})
        for (int i = 0; i < 150; ++i) {
            const Triangle2 t = random_triangle(random, reach, 1);
            Triangle2 doubled = t;
            std::shuffle(doubled.corner.begin(), doubled.corner.end(), random);
            for_each_sample(drawn({t, doubled}, 4), [](const Sample& s) { ASSERT_TRUE(s.top != 1 && s.bottom != 1); });
        }
}

TEST(Rasterizer, DepthsStayWithinThoseOfTheCorners) {
    std::mt19937_64 random(7);
    for (const std::int64_t reach : {2 * 256, 24 * 256, 500 * 256})
        for (int i = 0; i < 200; ++i) {
            const Triangle2 t = random_triangle(random, reach, 1);
            const auto [low, high] = std::minmax({t.corner[0].depth, t.corner[1].depth, t.corner[2].depth});
            for_each_sample(drawn({t}, 4), [low = low, high = high](const Sample& s) {
                if (s.top != 0) return;
                ASSERT_GE(double(s.highest), low - 0.02);   // of a grid step
                ASSERT_LE(double(s.highest), high + 0.02);
            });
        }
}

// Many triangles through one another: whatever is skipped as hidden must be hidden.
TEST(Rasterizer, EverySampleSeesTheHighestAndLowestOfManyTriangles) {
    std::mt19937_64 random(8);
    for (const std::int64_t reach : {std::int64_t{25 * 256}, std::int64_t{300 * 256}, std::int64_t{1} << 40}) {
        std::vector<Triangle2> triangles;
        for (int i = 0; i < 80; ++i) triangles.push_back(random_triangle(random, reach, 1));
        std::vector<Sample> expected;
        for_each_sample(empty_tile(4), [&](const Sample& s) { expected.push_back(s); });
        for (int id = 0; id < static_cast<int>(triangles.size()); ++id) {
            std::size_t i = 0;
            for_each_sample(drawn({triangles[static_cast<std::size_t>(id)]}, 4), [&](const Sample& s) {
                Sample& e = expected[i++];
                if (s.top == 0 && s.highest > e.highest) e.highest = s.highest, e.top = id;
                if (s.bottom == 0 && s.lowest < e.lowest) e.lowest = s.lowest, e.bottom = id;
            });
        }
        std::size_t i = 0;
        for_each_sample(drawn(triangles, 4), [&](const Sample& s) {
            const Sample& e = expected[i++];
            ASSERT_TRUE(s.top == e.top && s.bottom == e.bottom && s.highest == e.highest && s.lowest == e.lowest);
        });
    }
}

TEST(Rasterizer, DepthIsLinearOnThePlane) {
    // in grid steps, at places in grid steps from the corner of the tile
    const auto z = [](double x, double y) { return 768 + 0.125 * x - 0.25 * y; };
    const auto corner = [&](std::int64_t x, std::int64_t y) {
        return ScreenPoint{left + x, top + y, z(static_cast<double>(x), static_cast<double>(y))};
    };
    for (const std::int64_t scale : {1, 4}) {
        int seen = 0;
        for_each_sample(
            drawn({{{{corner(-2000 * scale, -800 * scale), corner(9600 * scale, 480 * scale), corner(400 * scale, 8800 * scale)}}}}, 1),
            [&](const Sample& s) {
                if (s.top != 0) return;
                ++seen;
                ASSERT_NEAR(double(s.highest), z(static_cast<double>(s.x - left), static_cast<double>(s.y - top)), 0.01);
            });
        EXPECT_GT(seen, 200);
    }
}

/// Runs with one instruction set only, where the processor has it.
class InstructionSet : public testing::TestWithParam<std::pair<const char*, std::int64_t>> {
protected:
    void SetUp() override {
        if ((hwy::SupportedTargets() & GetParam().second) == 0) GTEST_SKIP() << "this processor has no " << GetParam().first;
        hwy::SetSupportedTargetsForTest(GetParam().second);
    }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};
INSTANTIATE_TEST_SUITE_P(All, InstructionSet,
                         testing::Values(std::pair("SSE4", HWY_SSE4), std::pair("AVX2", HWY_AVX2), std::pair("AVX512", HWY_AVX3)),
                         [](const auto& set) { return std::string(set.param.first); });

TEST_P(InstructionSet, CoverageIsExact) {
    expect_exact(6 * 256, 1, 60, 21);
    expect_exact(20 * 256, 32, 60, 22);
}

TEST_P(InstructionSet, PicturesHaveTheSameBytesAsWithTheLeastOne) {
    const render_tests::Mesh mesh = render_tests::pebble();
    render::Surface surface = mesh.surface();
    std::vector<double> values = mesh.values;
    for (std::size_t i = 0; i < values.size(); i += 17) values[i] = std::nan("");
    surface.values = values;
    for (const int samples : {1, 4, 16})
        for (const bool occlusion : {false, true}) {
            render::DrawOptions options{.width = 203, .height = 161};
            options.range = {nullptr, -400, 400};
            options.samples = samples, options.occlusion = occlusion, options.edges = occlusion, options.isoline_spacing = 90;
            hwy::SetSupportedTargetsForTest(GetParam().second);
            std::vector<render::View> views(render::six_views.begin(), render::six_views.end());
            views.push_back(render::three_quarter_view());
            if (samples == 4) options.background = {200, 220, 240, 100};
            const auto here = render::draw_views(surface, views, options);
            hwy::SetSupportedTargetsForTest(HWY_SSSE3);
            const auto least = render::draw_views(surface, views, options);
            for (std::size_t v = 0; v < here.size(); ++v)
                EXPECT_EQ(render_tests::differing_pixels(here[v], least[v]), 0)
                    << views[v].name << ", " << samples << " samples, " << occlusion;
        }
}

/// Wide triangles, and the same with each followed by itself, its corners in another order.
TEST(Rasterizer, TrianglesThatRepeatEarlierOnesAreNotSeen) {
    std::mt19937_64 random(11);
    std::vector<Triangle2> once, repeated;
    for (int i = 0; i < 200; ++i) once.push_back(random_triangle(random, 200 * 256, 1));
    repeated = once;
    for (const Triangle2& t : once)
        repeated.push_back({{t.corner[2], t.corner[0], t.corner[1]}}), repeated.push_back({{t.corner[1], t.corner[0], t.corner[2]}});
    const SampleTile of_once = drawn_wide(once, 4), of_repeated = drawn_wide(repeated, 4);
    for (int row = 0; row < of_once.blocks_on_side(); ++row)
        for (int column = 0; column < of_once.blocks_on_side(); ++column) {
            ASSERT_EQ(of_once.row(row)[column].top, of_repeated.row(row)[column].top);
            ASSERT_EQ(of_once.row(row)[column].bottom, of_repeated.row(row)[column].bottom);
        }
}

TEST(Rasterizer, EndlessOverdrawIsRefused) {
    render::WideBudget nothing_left(-1'600'000);
    SampleTile tile(render::four_samples, &nothing_left);
    tile.start(tile_x, tile_y);
    std::mt19937_64 random(12);
    const auto draw = [&](int count) {
        for (int i = 0; i < count; ++i) render::rasterize_wide(random_triangle(random, 200 * 256, 1), i, tile);
    };
    EXPECT_NO_THROW(draw(4));   // counted in portions
    EXPECT_THROW(draw(10000), render::TooMuchOverdraw);
    EXPECT_THROW(nothing_left.list(1'000'000'000), render::TooMuchOverdraw);
}

}   // namespace
