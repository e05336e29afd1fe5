#include "rasterizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "render/shapes.h"

namespace {

using render::SampleBand;
using render::SampleOffset;
using render::ScreenPoint;
using render::Triangle2;
using render::Visible;
using render_tests::random_integer;

__extension__ using Wide = __int128;

/// Is the edge from a to b right of the point p + (ε, ε²), on its height? Exact.
bool crosses_ray(const ScreenPoint& a, const ScreenPoint& b, std::int64_t px, std::int64_t py) {
    if ((a.y <= py) == (b.y <= py)) return false;
    const ScreenPoint &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    // x of the crossing > px, multiplied by the positive height of the edge
    return Wide(high.x - low.x) * (py - low.y) + Wide(low.x - px) * (high.y - low.y) > 0;
}

/// The slow reference: a ray from the sample to the right crosses the outline an odd number of times. The infinitesimal shift to the
/// right and (still smaller) down settles samples on edges and corners: the top-left rule, told in another way.
bool covers(const Triangle2& t, std::int64_t px, std::int64_t py) {
    int crossings = 0;
    for (std::size_t k = 0; k < 3; ++k) crossings += crosses_ray(t.corner[k], t.corner[(k + 1) % 3], px, py) ? 1 : 0;
    return crossings % 2 == 1;
}

constexpr int width = 21, height = 17, first_row = 3;

/// Samples whose coverage differs from the reference.
int disagreements(const Triangle2& t, int samples) {
    SampleBand band(width, first_row, height, samples);
    render::rasterize(t, 7, band);
    int count = 0;
    for (int y = first_row; y < first_row + height; ++y)
        for (int x = 0; x < width; ++x)
            for (std::size_t s = 0; s < static_cast<std::size_t>(samples); ++s) {
                const SampleOffset o = band.offsets()[s];
                const bool expected = covers(t, x * render::subpixels + o.x, y * render::subpixels + o.y);
                count += (band.at(x, y)[s].triangle == 7) == expected ? 0 : 1;
            }
    return count;
}

/// Corners at random in ±`reach` round the band, on multiples of `step`.
Triangle2 random_triangle(std::mt19937_64& random, std::int64_t reach, std::int64_t step) {
    Triangle2 t;
    for (ScreenPoint& p : t.corner) {
        p.x = step * random_integer(random, -reach / step, reach / step);
        p.y = step * random_integer(random, -reach / step, reach / step);
        p.depth = static_cast<float>(random_integer(random, -100, 100));
    }
    return t;
}

void expect_exact(std::int64_t reach, std::int64_t step, int count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (int i = 0; i < count; ++i) {
        const Triangle2 t = random_triangle(random, reach, step);
        ASSERT_EQ(disagreements(t, 1), 0) << "triangle " << i;
        ASSERT_EQ(disagreements(t, 4), 0) << "triangle " << i;
    }
}

TEST(Rasterizer, CoverageEqualsTheExactReferenceForRandomTriangles) { expect_exact(24 * 256, 1, 1500, 1); }

// Corners on multiples of 32/256 pixel: many samples lie exactly on edges and corners.
TEST(Rasterizer, CoverageIsExactWhereSamplesLieOnEdges) { expect_exact(20 * 256, 32, 1500, 2); }

TEST(Rasterizer, CoverageIsExactForTrianglesOfAFewSubpixels) {
    std::mt19937_64 random(3);
    int covered = 0;
    for (int i = 0; i < 3000; ++i) {
        const ScreenPoint sample{128 + 256 * 9, 128 + 256 * 11, 0};
        Triangle2 t;
        for (ScreenPoint& p : t.corner) p = {sample.x + random_integer(random, -3, 3), sample.y + random_integer(random, -3, 3), 1};
        covered += covers(t, sample.x, sample.y) ? 1 : 0;
        ASSERT_EQ(disagreements(t, 1), 0) << "triangle " << i;
    }
    EXPECT_GT(covered, 300);   // however small, a triangle is drawn where it covers a sample
}

TEST(Rasterizer, CoverageIsExactForSlivers) {
    std::mt19937_64 random(4);
    for (int i = 0; i < 1500; ++i) {
        Triangle2 t = random_triangle(random, 24 * 256, 1);
        const ScreenPoint &a = t.corner[0], &b = t.corner[1];
        t.corner[2] = {(a.x + 2 * b.x) / 3 + random_integer(random, -1, 1), (a.y + 2 * b.y) / 3 + random_integer(random, -1, 1), 0};
        ASSERT_EQ(disagreements(t, 4), 0) << "triangle " << i;
    }
}

TEST(Rasterizer, CoverageIsExactForHugeTriangles) {
    for (const int bits : {20, 27, 28, 29, 40, 51}) expect_exact(std::int64_t{1} << bits, 1, 150, static_cast<std::uint64_t>(bits));
}

TEST(Rasterizer, TrianglesBeyondTheLimitAndDegenerateOnesCoverNothing) {
    SampleBand band(width, first_row, height, 4);
    const std::int64_t far = 2 * render::largest_coordinate;
    render::rasterize({{{{-far, -far, 0}, {far, -far, 0}, {0, far, 0}}}}, 1, band);
    render::rasterize({{{{0, 0, 0}, {2560, 2560, 0}, {5120, 5120, 0}}}}, 2, band);
    render::rasterize({{{{1184, 1184, 0}, {1184, 1184, 0}, {1184, 1184, 0}}}}, 3, band);
    for (int y = first_row; y < first_row + height; ++y)
        for (int x = 0; x < width; ++x)
            for (const Visible& v : band.at(x, y)) ASSERT_EQ(v.triangle, Visible::nothing);
}

// A jittered triangulation of a rectangle larger than the band, some of its corners on samples.
TEST(Rasterizer, TrianglesThatShareEdgesCoverEachSampleOnce) {
    std::mt19937_64 random(5);
    for (int round = 0; round < 20; ++round) {
        constexpr int n = 9, cell = 3 * 256;
        std::vector<ScreenPoint> points;
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const bool on_sample = random_integer(random, 0, 2) == 0;
                const std::int64_t jx = on_sample ? 128 : random_integer(random, -250, 250),
                                   jy = on_sample ? 128 : random_integer(random, -250, 250);
                points.push_back({cell * (i - 1) + jx, cell * (j - 1) + jy, static_cast<float>(i + j)});
            }
        std::vector<int> hits(static_cast<std::size_t>(width * height) * 4, 0);
        const auto hit = [&](int a, int b, int c) {
            SampleBand band(width, first_row, height, 4);
            const auto p = [&](int i) { return points[static_cast<std::size_t>(i)]; };
            render::rasterize({{{p(a), p(b), p(c)}}}, 0, band);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    for (std::size_t s = 0; s < 4; ++s)
                        hits[static_cast<std::size_t>(y * width + x) * 4 + s] += band.at(x, first_row + y)[s].triangle == 0 ? 1 : 0;
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

TEST(Rasterizer, TheNearestTriangleIsSeenWhateverTheOrder) {
    const Triangle2 near{{{{0, 0, 5}, {8000, 0, 5}, {0, 8000, 5}}}}, behind{{{{0, 0, -5}, {8000, 0, -5}, {0, 8000, -5}}}};
    for (const bool near_first : {true, false}) {
        SampleBand band(width, first_row, height, 1);
        render::rasterize(near_first ? near : behind, near_first ? 1 : 2, band);
        render::rasterize(near_first ? behind : near, near_first ? 2 : 1, band);
        EXPECT_EQ(band.at(5, 5)[0].triangle, 1);
    }
}

TEST(Rasterizer, OfDoubledTrianglesTheFirstIsSeenWhateverTheOrderOfTheirCorners) {
    std::mt19937_64 random(6);
    for (int i = 0; i < 500; ++i) {
        const Triangle2 t = random_triangle(random, 20 * 256, 1);
        Triangle2 doubled = t;
        std::shuffle(doubled.corner.begin(), doubled.corner.end(), random);
        SampleBand band(width, first_row, height, 4);
        render::rasterize(t, 1, band);
        render::rasterize(doubled, 2, band);
        for (int y = first_row; y < first_row + height; ++y)
            for (int x = 0; x < width; ++x)
                for (const Visible& v : band.at(x, y)) ASSERT_NE(v.triangle, 2);
    }
}

TEST(Rasterizer, DepthsStayWithinThoseOfTheCorners) {
    std::mt19937_64 random(7);
    for (int i = 0; i < 1000; ++i) {
        Triangle2 t = random_triangle(random, 24 * 256, 1);
        const auto [low, high] = std::minmax({t.corner[0].depth, t.corner[1].depth, t.corner[2].depth});
        SampleBand band(width, first_row, height, 4);
        render::rasterize(t, 0, band);
        for (int y = first_row; y < first_row + height; ++y)
            for (int x = 0; x < width; ++x)
                for (const Visible& v : band.at(x, y)) {
                    if (v.triangle != 0) continue;
                    ASSERT_GE(v.depth, low - 1e-4F);
                    ASSERT_LE(v.depth, high + 1e-4F);
                }
    }
}

// Many large triangles through one another: whatever is skipped as hidden must be hidden.
TEST(Rasterizer, EverySampleSeesTheNearestOfManyLargeTriangles) {
    std::mt19937_64 random(8);
    constexpr int columns = 150, rows = 32, count = 120;
    for (const std::int64_t reach : {std::int64_t{300 * 256}, std::int64_t{1} << 40}) {
        std::vector<Triangle2> triangles;
        for (int i = 0; i < count; ++i) triangles.push_back(random_triangle(random, reach, 1));
        SampleBand together(columns, 0, rows, 4);
        for (int i = 0; i < count; ++i) render::rasterize(triangles[static_cast<std::size_t>(i)], i, together);
        std::vector<Visible> nearest(static_cast<std::size_t>(columns * rows * 4));
        for (int i = 0; i < count; ++i) {
            SampleBand alone(columns, 0, rows, 4);
            render::rasterize(triangles[static_cast<std::size_t>(i)], i, alone);
            for (std::size_t s = 0; s < nearest.size(); ++s)
                if (alone.pixel(0, 0)[s].depth > nearest[s].depth) nearest[s] = alone.pixel(0, 0)[s];
        }
        for (std::size_t s = 0; s < nearest.size(); ++s) {
            ASSERT_EQ(together.pixel(0, 0)[s].triangle, nearest[s].triangle);
            ASSERT_EQ(together.pixel(0, 0)[s].depth, nearest[s].depth);
        }
    }
}

TEST(Rasterizer, DepthIsLinearOnThePlane) {
    // z = 3 + x/10 − y/5 in pixels
    const auto z = [](double x, double y) { return 3 + 0.1 * x - 0.2 * y; };
    const auto corner = [&](std::int64_t x, std::int64_t y) {
        return ScreenPoint{x, y, static_cast<float>(z(double(x) / 256, double(y) / 256))};
    };
    SampleBand band(width, first_row, height, 1);
    render::rasterize({{{corner(-3000, -1000), corner(9000, 500), corner(400, 9000)}}}, 0, band);
    int seen = 0;
    for (int y = first_row; y < first_row + height; ++y)
        for (int x = 0; x < width; ++x)
            if (const Visible& v = band.at(x, y)[0]; v.triangle == 0) {
                ++seen;
                ASSERT_NEAR(static_cast<double>(v.depth), z(x + 0.5, y + 0.5), 1e-5);
            }
    EXPECT_GT(seen, 200);
}

}   // namespace
