// The visible qualities of pictures: clay stands out on white, values can be read, backs and undefined values are distinct.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "color/srgb.h"
#include "draw_mesh.h"
#include "render/color_difference.h"
#include "render/picture_box.h"
#include "render/shapes.h"

namespace {

using render::DrawOptions;
using render::Image;
using render::lab_of;
using render::Rgba;
using render_tests::box;
using render_tests::grid;
using render_tests::Mesh;
using render_tests::pebble;
using render_tests::white;

double lightness(Rgba c) { return lab_of(c).x; }
double luminance(Rgba c) {
    return 0.2126 * double(render::linear_of(c.r)) + 0.7152 * double(render::linear_of(c.g)) + 0.0722 * double(render::linear_of(c.b));
}

std::vector<Image> drawn_along_axes(const Mesh& mesh, const DrawOptions& options) {
    return render::draw_views(mesh.surface(), render::six_views, options);
}

Mesh clay_pebble() {
    Mesh mesh = pebble();
    mesh.values.clear();
    return mesh;
}

/// A surface that turns every way, with deep hollows.
Mesh crumpled(double value) {
    Mesh mesh = pebble();
    for (glm::dvec3& p : mesh.positions) p *= 1 + 0.25 * std::sin(0.05 * p.x) * std::cos(0.04 * p.y + 0.03 * p.z);
    std::fill(mesh.values.begin(), mesh.values.end(), value);
    return mesh;
}

TEST(Clay, HasAnLStarOf92UnderTheKeyLightAndDarkensInTheShade) {
    std::vector<double> seen;
    const auto pictures = drawn_along_axes(clay_pebble(), {.width = 300, .height = 300, .occlusion = false});
    for (const Rgba p : pictures[4].pixels)
        if (p != white) seen.push_back(lightness(p));
    std::sort(seen.begin(), seen.end());
    const auto share = [&](double s) { return seen[static_cast<std::size_t>(s * static_cast<double>(seen.size() - 1))]; };
    EXPECT_NEAR(share(0.99), 92, 1.5);
    EXPECT_LT(share(0.02), 60);
    EXPECT_GT(share(0.75) - share(0.25), 8);
}

// Black of 35 % over a nearly white edge: a contrast of at least 3 : 1 between line and page.
TEST(Outlines, ASheetThatFacesTheViewerDoesNotDissolveOnWhite) {
    const Image image = drawn_along_axes(grid(2), {.width = 100, .height = 100})[4];
    const int left = 4;   // 0.92 of the width: from 4 to 96
    double darkest = 1;
    int dark = 0;
    for (int x = 0; x < 12; ++x) {
        darkest = std::min(darkest, luminance(image.at(x, 50)));
        dark += luminance(image.at(x, 50)) < 0.75 * luminance(image.at(50, 50)) ? 1 : 0;
    }
    EXPECT_LT(darkest, 0.45 * luminance(image.at(50, 50)));
    EXPECT_GE(dark, 1);
    EXPECT_LE(dark, 2) << "wider than 1.5 pixels";
    EXPECT_EQ(image.at(left - 1, 50), white);
}

// From three quarters, the faces of a box meet in lines, and there are no other lines.
TEST(Outlines, CreasesAreDrawnAndPlanesAndSpheresHaveNone) {
    DrawOptions options{.width = 200, .height = 200, .samples = 4};
    const auto hero = [&](const Mesh& mesh) {
        return render::draw_views(mesh.surface(), std::array{render::three_quarter_view()}, options)[0];
    };
    const Image cube = hero(box({-1, -1, -1}, {1, 1, 1}));
    int lines = 0;
    for (int y = 20; y < 180; ++y)   // the upright edge between the front and the side
        for (int x = 60; x < 140; ++x)
            lines += luminance(cube.at(x, y)) < 0.85 * std::min(luminance(cube.at(x - 3, y)), luminance(cube.at(x + 3, y))) ? 1 : 0;
    EXPECT_GT(lines, 40);
    Mesh ball;   // fine: no folds that could be seen
    constexpr int rings = 60;
    const double pi = std::acos(-1.0);
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < 2 * rings; ++j)
            ball.positions.push_back({std::sin(pi * i / rings) * std::sin(pi * j / rings), std::cos(pi * i / rings),
                                      std::sin(pi * i / rings) * std::cos(pi * j / rings)});
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < 2 * rings; ++j) {
            const int a = i * 2 * rings + j, b = i * 2 * rings + (j + 1) % (2 * rings), c = a + 2 * rings, d = b + 2 * rings;
            ball.triangles.push_back({a, c, b}), ball.triangles.push_back({b, c, d});
        }
    const Image with = hero(ball);
    options.occlusion = false;   // without lines either
    const Image without = hero(ball);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x)
            if (std::hypot(x - 99.5, y - 99.5) < 89) {
                ASSERT_NEAR(with.at(x, y).g, without.at(x, y).g, 3) << x << " " << y;
            }
}

// Light and occlusion together leave 0.88 of the luminance of a colour, so that L* differs by 5 at most and it can be read as a number.
// Lines are no part of it: where one view is flat there is none.
TEST(Values, KeepTheLuminanceOfTheirColourOnEverySide) {
    for (const char* name : {"diverging", "pale", "viridis"})
        for (const double value : {0.0, 0.3, 0.8}) {
            DrawOptions options{.width = 160, .height = 160, .range = {&render::colormap_named(name), 0, 1}};
            const double full = luminance(render::color_at(*options.range.colormap, value)), rounding = 0.004;
            std::vector<double> shares;
            for (const Image& image : drawn_along_axes(crumpled(value), options))
                for (const Rgba p : image.pixels)
                    if (p != white) shares.push_back(luminance(p) / full);
            std::sort(shares.begin(), shares.end());
            EXPECT_LE(shares[shares.size() * 9 / 10], 1 + rounding / full) << name << value;   // the rest is the silhouette's
            options.occlusion = false;                                                         // light alone, and no lines
            std::vector<double> lit;
            for (const Image& image : drawn_along_axes(crumpled(value), options))
                for (int y = 1; y < 159; ++y)
                    for (int x = 1; x < 159; ++x) {
                        const bool inside = image.at(x - 1, y) != white && image.at(x + 1, y) != white && image.at(x, y - 1) != white &&
                                            image.at(x, y + 1) != white;
                        if (inside && image.at(x, y) != white) lit.push_back(luminance(image.at(x, y)) / full);
                    }
            EXPECT_GT(*std::min_element(lit.begin(), lit.end()), 0.9 - rounding / full) << name << value;
        }
}

TEST(Values, KeepTheLuminanceOfTheirColourAtTheBottomOfAHollow) {
    Mesh well = grid(40);   // a pit with a flat floor: occluded, and far from any line
    for (glm::dvec3& p : well.positions) p.z = std::max(std::abs(p.x), std::abs(p.y)) < 0.09 ? -1 : 0;
    well.values.assign(well.positions.size(), 0.5);
    DrawOptions options{.width = 400, .height = 400, .range = {&render::colormap_named("pale"), 0, 1}};
    const double full = luminance(render::color_at(*options.range.colormap, 0.5));
    const auto floor_of = [&](bool occlusion) {
        options.occlusion = occlusion;
        return luminance(drawn_along_axes(well, options)[4].at(200, 200));
    };
    EXPECT_GE(floor_of(true), 0.88 * full);
    EXPECT_LT(floor_of(true), 0.995 * floor_of(false));
}

TEST(Backs, ClayIsBluerAndValuesAreHatchedOnTheBack) {
    const Rgba front = drawn_along_axes(grid(3), {.width = 60, .height = 60})[4].at(30, 30),
               back = drawn_along_axes(grid(3), {.width = 60, .height = 60})[5].at(30, 30);
    EXPECT_LT(lab_of(back).z, lab_of(front).z - 5);
    EXPECT_GT(render::delta_e_2000(lab_of(front), lab_of(back)), 8);
    for (const double value : {0.0, 0.5, 1.0}) {
        Mesh sheet = grid(3);
        sheet.values.assign(sheet.positions.size(), value);
        DrawOptions options{.width = 60, .height = 60, .range = {&render::colormap_named("viridis"), 0, 1}};
        const auto pictures = drawn_along_axes(sheet, options);
        int as_in_front = 0, hatched = 0;
        for (int y = 20; y < 40; ++y)
            for (int x = 20; x < 40; ++x) {
                const double apart = render::delta_e_2000(lab_of(pictures[4].at(x, y)), lab_of(pictures[5].at(x, y)));
                as_in_front += apart < 1 ? 1 : 0, hatched += apart > 6 ? 1 : 0;
            }
        EXPECT_GT(as_in_front, 100) << value;   // its colour can be read
        EXPECT_GT(hatched, 45) << value;
    }
}

// On dark and light pages, undefined values are neutral, with lines in the other direction than on backs.
TEST(Undefined, IsNeutralAndHatchedInTheOtherDirectionThanBacks) {
    Mesh sheet = grid(3);
    sheet.values.assign(sheet.positions.size(), 0.5);
    const DrawOptions options{.width = 80, .height = 80, .range = {&render::colormap_named("pale"), 0, 1}};
    const Image back = drawn_along_axes(sheet, options)[5];
    sheet.values.assign(sheet.positions.size(), std::numeric_limits<double>::quiet_NaN());
    const Image front = drawn_along_axes(sheet, options)[4];
    const auto along = [](const Image& image, int slope) {   // mean difference along a diagonal
        double sum = 0;
        for (int y = 30; y < 50; ++y)
            for (int x = 30; x < 50; ++x) sum += std::abs(lightness(image.at(x, y)) - lightness(image.at(x + 1, y + slope)));
        return sum / 400;
    };
    EXPECT_GT(along(front, 1), 3 * along(front, -1));
    EXPECT_GT(along(back, -1), 3 * along(back, 1));
    for (int x = 30; x < 50; ++x) EXPECT_LT(std::hypot(lab_of(front.at(x, 40)).y, lab_of(front.at(x, 40)).z), 1);
}

TEST(Samples, TheHeroHasSixteenthsOfCoverageAndTheSixViewsHaveQuarters) {
    DrawOptions options{.width = 64, .height = 64, .background = {255, 255, 255, 0}};
    const Mesh mesh = pebble();
    const auto levels = [&](const Image& image, int parts) {
        std::vector<bool> seen(static_cast<std::size_t>(parts) + 1);
        for (const Rgba p : image.pixels) {
            const double level = p.a * parts / 255.0;
            EXPECT_NEAR(level, std::round(level), 0.04);
            seen[static_cast<std::size_t>(std::lround(level))] = true;
        }
        return std::count(seen.begin(), seen.end(), true);
    };
    EXPECT_GE(levels(render::draw_views(mesh.surface(), std::array{render::three_quarter_view()}, options)[0], 16), 15);
    EXPECT_EQ(levels(drawn_along_axes(mesh, options)[4], 4), 5);
}

}   // namespace
