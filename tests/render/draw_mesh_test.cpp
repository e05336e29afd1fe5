#include "draw_mesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <stdexcept>

#include "color/srgb.h"
#include "render/color_difference.h"
#include "render/picture_box.h"
#include "render/shapes.h"
#include "scene/camera.h"
#include "scene/outline.h"
#include "scene/scene.h"
#include "shading/shading_style.h"

namespace {

using render::DrawOptions;
using render::Image;
using render::Rgba;
using render::six_views;
using render_tests::box;
using render_tests::differing_pixels;
using render_tests::grid;
using render_tests::Mesh;
using render_tests::pebble;
using render_tests::white;

/// The options of `render --plain`.
DrawOptions plain(int width, int height) { return {.width = width, .height = height, .fill = 0.95, .shading = false, .samples = 1}; }

DrawOptions shaded(int size, const char* colormap, double low, double high) {
    return {.width = size, .height = size, .range = {&render::colormap_named(colormap), low, high}};
}

std::vector<Image> six_pictures(const Mesh& mesh, const DrawOptions& options) {
    return render::draw_views(mesh.surface(), six_views, options);
}

int inked_pixels(const Image& image) {
    return static_cast<int>(std::count_if(image.pixels.begin(), image.pixels.end(), [](Rgba p) { return p != white; }));
}

/// Columns and rows of the pixels that are not white: first, one past the last.
struct Extent {
    int x0 = 1 << 20, x1 = 0, y0 = 1 << 20, y1 = 0;
};

Extent extent_of(const Image& image) {
    Extent e;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y) != white) e = {std::min(e.x0, x), std::max(e.x1, x + 1), std::min(e.y0, y), std::max(e.y1, y + 1)};
    return e;
}

// ---- the six views of the contract ----------------------------------------------------------------------------------

// Up is +y for ±x and ±z, −z for +y, +z for −y; in the +x view −z points right, in the +z view +x, in the +y view +x.
TEST(SixViews, EachAxisPointsWhereTheContractSays) {
    struct Expected {
        const char* name;
        glm::dvec3 right, up;
    };
    const std::vector<Expected> table{{"+x", {0, 0, -1}, {0, 1, 0}}, {"-x", {0, 0, 1}, {0, 1, 0}}, {"+y", {1, 0, 0}, {0, 0, -1}},
                                      {"-y", {1, 0, 0}, {0, 0, 1}},  {"+z", {1, 0, 0}, {0, 1, 0}}, {"-z", {-1, 0, 0}, {0, 1, 0}}};
    for (int axis = 0; axis < 3; ++axis) {
        Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
        for (const glm::dvec3& p : mesh.positions) mesh.values.push_back(p[axis]);
        DrawOptions options = plain(101, 101);
        options.range = {&render::colormap_named("grey"), -1, 1};
        const std::vector<Image> images = six_pictures(mesh, options);
        for (std::size_t v = 0; v < 6; ++v) {
            ASSERT_EQ(six_views[v].name, table[v].name);
            const Image& image = images[v];
            const double to_right = table[v].right[axis], to_top = table[v].up[axis];
            const auto is_high = [&](int x, int y) { return image.at(x, y).r > 119; };
            if (to_right != 0) {
                EXPECT_EQ(is_high(94, 50), to_right > 0) << six_views[v].name << " axis " << axis;
                EXPECT_EQ(is_high(6, 50), to_right < 0) << six_views[v].name << " axis " << axis;
            } else if (to_top != 0) {
                EXPECT_EQ(is_high(50, 6), to_top > 0) << six_views[v].name << " axis " << axis;
                EXPECT_EQ(is_high(50, 94), to_top < 0) << six_views[v].name << " axis " << axis;
            } else {   // the side that the view is named after
                EXPECT_EQ(is_high(50, 50), six_views[v].name[0] == '+') << six_views[v].name;
            }
        }
    }
}

TEST(SixViews, AnUnevenBoxIsCentredAndOnOneScale) {
    const Mesh mesh = box({10, -7, 100}, {14, 1, 102});   // 4 × 8 × 2
    const int width = 400, height = 320;
    const double scale = 0.95 * height / 8;
    const std::vector<Image> images = six_pictures(mesh, plain(width, height));
    const std::array<std::array<double, 2>, 6> sizes{{{2, 8}, {2, 8}, {4, 2}, {4, 2}, {4, 8}, {4, 8}}};
    for (std::size_t v = 0; v < 6; ++v) {
        const Extent e = extent_of(images[v]);
        EXPECT_NEAR(e.x1 - e.x0, scale * sizes[v][0], 1) << six_views[v].name;
        EXPECT_NEAR(e.y1 - e.y0, scale * sizes[v][1], 1) << six_views[v].name;
        EXPECT_NEAR(e.x0 + e.x1, width, 1) << six_views[v].name;
        EXPECT_NEAR(e.y0 + e.y1, height, 1) << six_views[v].name;
        EXPECT_EQ(inked_pixels(images[v]), (e.x1 - e.x0) * (e.y1 - e.y0)) << six_views[v].name;   // no holes
    }
}

TEST(SixViews, TheNearerOfTwoSquaresIsSeenFromEachSide) {
    Mesh mesh = grid(1);   // value 0 at z = 0
    for (const glm::dvec3& p : grid(1).positions) mesh.positions.push_back(p + glm::dvec3(0, 0, 0.5));
    for (const glm::ivec3& t : grid(1).triangles) mesh.triangles.push_back(t + 4);
    mesh.values = {0, 0, 0, 0, 1, 1, 1, 1};
    DrawOptions options = plain(50, 50);
    options.range = {&render::colormap_named("diverging"), 0, 1};
    const std::vector<Image> images = six_pictures(mesh, options);
    EXPECT_EQ(images[4].at(25, 25), render::color_at(*options.range.colormap, 1));   // +z
    EXPECT_EQ(images[5].at(25, 25), render::color_at(*options.range.colormap, 0));   // −z
}

// ---- colours --------------------------------------------------------------------------------------------------------

TEST(DrawViews, PlainPicturesHaveTwoColours) {
    for (const Image& image : six_pictures(pebble(), [] {
             DrawOptions o = plain(120, 90);
             o.range.colormap = nullptr;
             return o;
         }()))
        EXPECT_GT(inked_pixels(image), 1000);
    Mesh mesh = pebble();
    mesh.values.clear();
    for (const Image& image : six_pictures(mesh, plain(120, 90)))
        for (const Rgba p : image.pixels) ASSERT_TRUE(p == white || p == DrawOptions{}.surface_color);
}

TEST(DrawViews, ColoursCanEncodeTheNumbersOfTriangles) {
    Mesh mesh = grid(20);   // 800 triangles: the green channel is needed
    DrawOptions options = plain(400, 400);
    options.face_colors_from_id = true;
    const Image image = six_pictures(mesh, options)[4];
    const double scale = 0.95 * 400 / 2;
    for (int y = 15; y < 385; y += 7)
        for (int x = 15; x < 385; x += 7) {
            const Rgba p = image.at(x, y);
            const auto id = static_cast<std::size_t>(p.r * 65536 + p.g * 256 + p.b - 1);
            ASSERT_LT(id, mesh.triangles.size());
            const glm::dvec3 at((x + 0.5 - 200) / scale, (200 - y - 0.5) / scale, 0);
            for (int k = 0; k < 3; ++k) {   // inside, up to the snapping of the corners
                const glm::dvec3 a = mesh.positions[static_cast<std::size_t>(mesh.triangles[id][k])];
                const glm::dvec3 b = mesh.positions[static_cast<std::size_t>(mesh.triangles[id][(k + 1) % 3])];
                ASSERT_GT(glm::cross(b - a, at - a).z, -0.01 * glm::length(b - a) / scale);
            }
        }
}

TEST(DrawViews, ValuesAreInterpolatedBeforeTheyAreColoured) {
    Mesh mesh = grid(1);
    for (const glm::dvec3& p : mesh.positions) mesh.values.push_back(p.x);
    DrawOptions options = plain(200, 200);
    options.range = {&render::colormap_named("viridis"), -1, 1};
    const Image image = six_pictures(mesh, options)[4];
    for (int x = 6; x < 194; ++x) {
        const double value = (x + 0.5 - 100) / (0.95 * 100);
        const Rgba expected = render::color_at(*options.range.colormap, (value + 1) / 2);
        for (const int y : {20, 99, 170}) {
            ASSERT_NEAR(image.at(x, y).r, expected.r, 2);
            ASSERT_NEAR(image.at(x, y).g, expected.g, 2);
            ASSERT_NEAR(image.at(x, y).b, expected.b, 2);
        }
    }
}

TEST(DrawViews, ValuesBeyondTheRangeHaveTheColoursOfItsEnds) {
    for (const double value : {2.0, 1e300, std::numeric_limits<double>::infinity()}) {
        Mesh mesh = grid(1);
        mesh.values.assign(4, value);
        DrawOptions options = plain(20, 20);
        options.range = {&render::colormap_named("magma"), 0, 1};
        EXPECT_EQ(six_pictures(mesh, options)[4].at(10, 10), options.range.colormap->stops.back());
        mesh.values.assign(4, -value);
        EXPECT_EQ(six_pictures(mesh, options)[4].at(10, 10), options.range.colormap->stops.front());
    }
}

TEST(DrawViews, AnUndefinedValueColoursThePointsNearestToItsVertex) {
    Mesh mesh = grid(2);
    mesh.values.assign(9, 0.5);
    mesh.values[4] = std::nan("");   // the middle
    DrawOptions options = plain(200, 200);
    options.range = {&render::colormap_named("viridis"), 0, 1};
    const Image image = six_pictures(mesh, options)[4];
    EXPECT_EQ(image.at(100, 100), options.undefined_color);
    EXPECT_EQ(image.at(110, 97), options.undefined_color);
    EXPECT_EQ(image.at(10, 10), render::color_at(*options.range.colormap, 0.5));
    EXPECT_EQ(image.at(180, 100), render::color_at(*options.range.colormap, 0.5));
}

// Lights are neutral and never above 1: shading scales linear light and leaves its proportions alone.
TEST(DrawViews, ShadingKeepsTheHueOfTheColours) {
    Mesh mesh = pebble();
    std::fill(mesh.values.begin(), mesh.values.end(), 0.4);
    const DrawOptions options = shaded(150, "magma", 0, 1);
    const render::LinearColor base = render::linear_of(render::color_at(*options.range.colormap, 0.4));
    int shades = 0;
    for (const Image& image : six_pictures(mesh, options))
        for (int y = 40; y < 110; ++y)
            for (int x = 50; x < 100; ++x) {
                const render::LinearColor c = render::linear_of(image.at(x, y));
                if (image.at(x, y) == white || c.b < 0.05F) continue;
                ASSERT_NEAR(c.r / c.b, base.r / base.b, 0.05F * base.r / base.b);
                ASSERT_LE(c.r, 1.01F * base.r);
                ++shades;
            }
    EXPECT_GT(shades, 5000);
}

TEST(DrawViews, TheBackOfAnOpenSurfaceHasAnotherColour) {
    DrawOptions options{.width = 60, .height = 60};
    const auto middle = [&](std::size_t view) { return six_pictures(grid(3), options)[view].at(30, 30); };
    EXPECT_NE(middle(4), middle(5));
    options.backface_tint = false;
    EXPECT_EQ(middle(4), middle(5));
}

// A colour stands for one value: nothing of the side it is seen from but a hatch, and little of the light.
TEST(DrawViews, ValuesLookTheSameOnBothSidesAndMuchLikeTheColourBar) {
    for (const char* name : {"diverging", "pale"}) {
        for (const double value : {0.0, 0.5, 1.0}) {
            Mesh sheet = grid(3);
            sheet.values.assign(sheet.positions.size(), value);
            DrawOptions options{.width = 60, .height = 60, .backface_tint = false};
            options.range = {&render::colormap_named(name), 0, 1};
            const auto pictures = six_pictures(sheet, options);
            EXPECT_EQ(pictures[4].at(30, 30), pictures[5].at(30, 30)) << name << ' ' << value;
            const glm::dvec3 bar = render::lab_of(render::color_at(render::colormap_named(name), value));
            EXPECT_LT(render::delta_e_2000(render::lab_of(pictures[4].at(30, 30)), bar), 5) << name << ' ' << value;
        }
    }
}

TEST(DrawViews, EdgesDarkenOnlyTheNeighbourhoodOfEdges) {
    DrawOptions options{.width = 200, .height = 200};
    const Image without = six_pictures(grid(2), options)[4];
    options.edges = true;
    const Image with = six_pictures(grid(2), options)[4];
    EXPECT_LT(with.at(100, 150).r, without.at(100, 150).r - 15);   // beside the line x = 0
    EXPECT_EQ(with.at(130, 170), without.at(130, 170));            // inside a triangle
    for (std::size_t i = 0; i < with.pixels.size(); ++i) ASSERT_LE(with.pixels[i].r, without.pixels[i].r);
}

// ---- coverage, outlines, transparency -------------------------------------------------------------------------------

// The value x over [−1, 1] with lines every ½: three inner lines, upright, a pixel or so wide, and nothing between them.
TEST(DrawViews, IsolinesRunWhereTheValueIsAMultipleOfTheirSpacing) {
    Mesh mesh = grid(6);
    for (const glm::dvec3& p : mesh.positions) mesh.values.push_back(p.x);
    DrawOptions options = plain(200, 200);
    options.range = {&render::colormap_named("viridis"), -1, 1};
    const Image without = six_pictures(mesh, options)[4];
    options.isoline_spacing = 0.5;
    const Image with = six_pictures(mesh, options)[4];
    for (int x = 0; x < 200; ++x) {
        const double value = (x + 0.5 - 100) / 95, from_line = std::abs(value / 0.5 - std::round(value / 0.5)) * 0.5 * 95;
        const bool inside = std::abs(value) < 0.98;
        if (inside && from_line < 0.6) {
            EXPECT_LT(with.at(x, 77).g, without.at(x, 77).g) << x;
        }
        if (inside && from_line > 1.6) {
            EXPECT_EQ(with.at(x, 77), without.at(x, 77)) << x;
        }
    }
}

TEST(DrawViews, AFlatPartOnALevelIsNotAnIsoline) {
    Mesh mesh = grid(2);
    mesh.values.assign(9, 0.5);
    DrawOptions options = plain(60, 60);
    options.range = {&render::colormap_named("viridis"), 0, 1};
    const Image without = six_pictures(mesh, options)[4];
    options.isoline_spacing = 0.5;
    EXPECT_EQ(differing_pixels(six_pictures(mesh, options)[4], without), 0);
}

TEST(DrawViews, AMarkOnTheEdgeOfThePictureHasARing) {
    const Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
    DrawOptions options = plain(200, 200);
    options.fill = 1;   // corners of the box lie in those of the picture
    const auto unmarked = six_pictures(mesh, options);
    const std::vector<int> corners{0, 1, 2, 3, 4, 5, 6, 7};
    options.marked_vertices = corners;
    const auto marked = six_pictures(mesh, options);
    for (std::size_t v = 0; v < 6; ++v) EXPECT_NE(marked[v].at(0, 5), unmarked[v].at(0, 5)) << render::six_views[v].name;
}

TEST(DrawViews, OnlyVisibleMarkedVerticesHaveRings) {
    const Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
    DrawOptions options = plain(200, 200);
    const auto unmarked = six_pictures(mesh, options);
    const std::vector<int> marks{7, 99, -1};   // the corner (1, 1, 1), and two that are not there
    options.marked_vertices = marks;
    const auto marked = six_pictures(mesh, options);
    for (std::size_t v = 0; v < 6; ++v) {
        const bool faces_it = glm::dot(render::six_views[v].from, glm::dvec3(1)) > 0;
        EXPECT_EQ(differing_pixels(marked[v], unmarked[v]) > 0, faces_it) << render::six_views[v].name;
    }
    // A few pixels behind a surface is hidden, too.
    Mesh layers = grid(1);
    for (const glm::dvec3& p : grid(1).positions) layers.positions.push_back({p.x, p.y, -0.06});
    layers.positions.push_back({0, 0, -0.06});
    layers.triangles.insert(layers.triangles.end(), {{4, 5, 8}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}});
    options.marked_vertices = {};
    const auto bare = six_pictures(layers, options);
    const std::vector<int> inner{8};
    options.marked_vertices = inner;
    const auto ringed = six_pictures(layers, options);
    EXPECT_EQ(differing_pixels(ringed[4], bare[4]), 0);
    EXPECT_GT(differing_pixels(ringed[5], bare[5]), 0);
}

TEST(DrawViews, FourSamplesGiveQuartersOfCoverage) {
    DrawOptions options{.width = 64, .height = 64, .background = {255, 255, 255, 0}};
    int partial = 0;
    for (const Image& image : six_pictures(pebble(), options))
        for (const Rgba p : image.pixels) {
            ASSERT_TRUE(p.a == 0 || p.a == 64 || p.a == 128 || p.a == 191 || p.a == 255) << int(p.a);
            partial += p.a > 0 && p.a < 255 ? 1 : 0;
        }
    EXPECT_GT(partial, 300);
}

TEST(DrawViews, APlaneSeenEdgeOnKeepsAnOutline) {
    DrawOptions options{.width = 100, .height = 100};
    for (const std::size_t v : {0, 1, 2, 3}) {
        const Image image = six_pictures(grid(4), options)[v];
        const Extent e = extent_of(image);
        EXPECT_NEAR(std::max(e.x1 - e.x0, e.y1 - e.y0), 92, 2) << six_views[v].name;
        EXPECT_LE(std::min(e.x1 - e.x0, e.y1 - e.y0), 4) << six_views[v].name;
    }
    options.shading = false;
    EXPECT_EQ(inked_pixels(six_pictures(grid(4), options)[0]), 0);
}

// ---- robustness -----------------------------------------------------------------------------------------------------

// A few triangles at the rim of a curved surface are seen edge-on; the rim gets no ribbons.
TEST(DrawViews, CurvedRimsKeepTheirWidth) {
    Mesh bowl = grid(24);
    for (glm::dvec3& p : bowl.positions) p.z = 0.9 * (p.x * p.x + p.y * p.y);
    const DrawOptions options{.width = 144, .height = 144};
    const render::Surface surface = bowl.surface();
    const render::Scene scene(surface, {{0, 0, 0.9}, 60}, options);
    const auto boundary = render::boundary_edges(surface);
    ASSERT_EQ(boundary.size(), 96U);
    for (const render::Projection& p : render::projections_of(six_views))
        EXPECT_TRUE(render::edge_on_ribbons(render::ProjectedScene(scene, p.axes), boundary, 2).empty());
}

TEST(DrawViews, BrokenTrianglesBesideRibbonsAreLeftOut) {
    Mesh mesh;
    mesh.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
    mesh.triangles = {{2000000000, 0, 1}, {0, 1, 2}, {-1, 2, 3}, {0, 2, 3}};
    Mesh whole = mesh;
    whole.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto with = six_pictures(mesh, {.width = 80, .height = 80}), without = six_pictures(whole, {.width = 80, .height = 80});
    for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(differing_pixels(with[v], without[v]), 0) << six_views[v].name;
}

TEST(DrawViews, AnEmptySurfaceAndNoViewsAreHarmless) {
    Mesh mesh;
    mesh.triangles = {{0, 1, 2}};
    const DrawOptions options{.width = 30, .height = 20, .frame = render::Frame{}};
    for (const Image& image : six_pictures(mesh, options)) EXPECT_EQ(inked_pixels(image), 0);
    EXPECT_TRUE(render::draw_views(grid(2).surface(), {}, options).empty());
}

// A frame may be far from the mesh, such as one that blew up beside its original.
TEST(DrawViews, OcclusionDoesNotHideDeepSurfaces) {
    for (const double depth : {-600000.0, -1e9, 1e9}) {
        Mesh mesh = grid(1);
        for (glm::dvec3& p : mesh.positions) p = {100 * p.x, 100 * p.y, depth};
        DrawOptions options{.width = 60, .height = 60, .frame = render::Frame{{0, 0, 0}, 1}};
        EXPECT_EQ(inked_pixels(six_pictures(mesh, options)[4]), 3600) << depth;
    }
}

// Corners that fit the grid along the axes of the model but not along those of the view.
TEST(DrawViews, ValuesAreRightIfOnlyTheTurnedCornersAreFarOff) {
    const render::View hero = render::three_quarter_view();
    const auto middle = [&](double s) {
        Mesh mesh = grid(1);
        mesh.values = {0, 1, 0, 1};
        for (glm::dvec3& p : mesh.positions) p = s * (p.x * hero.right() + p.y * hero.up);
        DrawOptions options{.width = 20, .height = 20, .frame = render::Frame{{0, 0, 0}, 1}, .range = {nullptr, 0, 1}};
        options.shading = false;
        return render::draw_views(mesh.surface(), std::array{hero}, options)[0].at(10, 10);
    };
    for (const double s : {20000.0, 32000.0, 40000.0}) {
        EXPECT_NEAR(middle(s).r, middle(100).r, 3) << s;
        EXPECT_NEAR(middle(s).g, middle(100).g, 6) << s;
    }
}

TEST(DrawViews, BrokenTrianglesAreLeftOut) {
    const Mesh mesh = pebble();
    Mesh broken = mesh;
    const auto first = static_cast<int>(broken.positions.size());
    for (const double x : {std::nan(""), HUGE_VAL, -HUGE_VAL}) broken.positions.push_back({x, 0, 0});
    broken.values.insert(broken.values.end(), {0, 0, 0});
    for (const glm::ivec3 t :
         {glm::ivec3(0, 1, first), {first + 1, 5, 9}, {4, first + 2, 2}, {-1, 2, 3}, {0, 1, 1 << 30}, {7, 7, 7}, {3, 3, 60}})
        broken.triangles.push_back(t);
    const DrawOptions options = shaded(90, "viridis", -400, 400);
    const std::vector<Image> expected = six_pictures(mesh, options), got = six_pictures(broken, options);
    for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(differing_pixels(expected[v], got[v]), 0);
}

TEST(DrawViews, NothingToDrawGivesTheBackground) {
    for (const Mesh& mesh : {Mesh{}, Mesh{{{std::nan(""), 0, 0}}, {{0, 0, 0}}}, Mesh{{{1, 2, 3}}, {{0, 0, 0}}}})
        for (const Image& image : six_pictures(mesh, {.width = 30, .height = 20})) EXPECT_EQ(inked_pixels(image), 0);
}

// Powers of two and integer offsets are exact in double, so the pictures must be equal to the byte.
TEST(DrawViews, ScaleAndPlaceOfTheModelDoNotMatter) {
    const Mesh mesh = pebble();
    const DrawOptions options = shaded(100, "viridis", -400, 400);
    const std::vector<Image> expected = six_pictures(mesh, options);
    const auto expect_same = [&](double scale, const glm::dvec3& offset) {
        Mesh moved = mesh;
        for (glm::dvec3& p : moved.positions) p = scale * p + offset;
        const std::vector<Image> got = six_pictures(moved, options);
        for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(differing_pixels(expected[v], got[v]), 0) << scale << " " << offset.x;
    };
    for (const int exponent : {100, 900, -40, -900}) expect_same(std::ldexp(1.0, exponent), glm::dvec3(0));
    expect_same(1, {1e15, -1e15, 1e15});
    expect_same(1, {1e6, 0, -3e9});
}

TEST(DrawViews, DecimalScalesGiveTheSamePictureUpToRounding) {
    const Mesh mesh = pebble();
    const DrawOptions options = shaded(100, "viridis", -400, 400);
    const std::vector<Image> expected = six_pictures(mesh, options);
    for (const double scale : {1e30, 1e-12, 1e300, 3e-300}) {
        Mesh scaled = mesh;
        for (glm::dvec3& p : scaled.positions) p *= scale;
        const std::vector<Image> got = six_pictures(scaled, options);
        for (std::size_t v = 0; v < 6; ++v) EXPECT_LE(differing_pixels(expected[v], got[v]), 20) << scale;
    }
}

TEST(DrawViews, TheWholeRangeOfDoubleCanBeFramed) {
    const double most = std::numeric_limits<double>::max();
    const Image image = six_pictures(box(glm::dvec3(-most), glm::dvec3(most)), plain(40, 40))[4];
    EXPECT_NEAR(inked_pixels(image), 38 * 38, 80);
}

// A mesh that blew up, drawn with the frame it had before: its triangles reach far beyond the picture.
TEST(DrawViews, CornersFarOutsideThePictureAreHarmless) {
    for (const double far : {1e3, 1e6, 1e9, 1e11}) {
        Mesh mesh{{{-far, -far, 0}, {far, -far, 0}, {0, far, 0}}, {{0, 1, 2}}};
        DrawOptions options = plain(64, 64);
        options.frame = render::Frame{{0, 0, 0}, 32};
        EXPECT_EQ(inked_pixels(six_pictures(mesh, options)[4]), 64 * 64) << far;
    }
    Mesh mesh{{{-1e250, -1e250, 0}, {1e250, -1e250, 0}, {0, 1e250, 1e300}}, {{0, 1, 2}}};
    DrawOptions options{.width = 64, .height = 64, .frame = render::Frame{{0, 0, 0}, 1e100}};
    EXPECT_EQ(six_pictures(mesh, options).size(), 6U);
}

TEST(DrawViews, AnyNumberOfThreadsGivesTheSameBytes) {
    const Mesh mesh = pebble();
    DrawOptions options = shaded(200, "diverging", -300, 300);
    options.edges = true;
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return six_pictures(mesh, options);
    };
    const std::vector<Image> one = with_threads(1), two = with_threads(2);
    for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(differing_pixels(one[v], two[v]), 0);
}

TEST(DrawViews, VerticesMayBeStoredInAnyOrder) {
    const Mesh mesh = pebble();
    std::vector<int> place(mesh.positions.size());
    std::iota(place.begin(), place.end(), 0);
    std::shuffle(place.begin(), place.end(), std::mt19937_64(1));
    Mesh stored = mesh;
    for (std::size_t i = 0; i < place.size(); ++i) {
        stored.positions[static_cast<std::size_t>(place[i])] = mesh.positions[i];
        stored.values[static_cast<std::size_t>(place[i])] = mesh.values[i];
    }
    for (glm::ivec3& t : stored.triangles)
        for (int k = 0; k < 3; ++k) t[k] = place[static_cast<std::size_t>(t[k])];
    const DrawOptions options = shaded(200, "diverging", -300, 300);
    const std::vector<Image> expected = six_pictures(mesh, options), pictures = six_pictures(stored, options);
    for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(differing_pixels(expected[v], pictures[v]), 0);
}

TEST(DrawViews, AtEqualDepthTheTriangleWithTheLowestNumberIsSeen) {
    const Mesh mesh = pebble();
    Mesh doubled = mesh;
    for (const glm::ivec3& t : mesh.triangles) doubled.triangles.push_back({t.y, t.z, t.x});
    DrawOptions options = plain(400, 400);
    options.face_colors_from_id = true;
    const std::vector<Image> expected = six_pictures(mesh, options), pictures = six_pictures(doubled, options);
    for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(differing_pixels(expected[v], pictures[v]), 0);
}

TEST(DrawViews, PicturesAreCutIntoTilesWithoutSeams) {
    // Draws a picture whole and as the upper part of a higher one at the same scale, with other tiles.
    const Mesh mesh = pebble();
    DrawOptions options = shaded(100, "viridis", -400, 400);
    options.frame = render::Frame{{0, 0, 0}, 0.1};
    const Image square = six_pictures(mesh, options)[4];
    options.height = 132;   // sixteen rows more above: the pattern of samples repeats every other row
    const Image high = six_pictures(mesh, options)[4];
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) ASSERT_EQ(square.at(x, y), high.at(x, y + 16)) << x << " " << y;
}

TEST(DrawViews, WrongOptionsAreRefused) {
    const Mesh mesh = grid(1);
    EXPECT_THROW(six_pictures(mesh, {.width = 0}), std::invalid_argument);
    EXPECT_THROW(six_pictures(mesh, {.height = 20000}), std::invalid_argument);
    EXPECT_THROW(six_pictures(mesh, {.samples = 3}), std::invalid_argument);
    Mesh odd = grid(1);
    odd.values = {1, 2};
    EXPECT_THROW(six_pictures(odd, {}), std::invalid_argument);
}

}   // namespace
