#include "scene/isolines.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "render/shapes.h"

namespace {

using render::DrawOptions;
using render::View;
using render_tests::Mesh;

using Lines = std::vector<std::vector<glm::dvec2>>;

Lines lines_of(const Mesh& mesh, const View& view, double spacing, int side = 400) {
    return render::visible_isolines(mesh.surface(), view, {.width = side, .height = side, .isoline_spacing = spacing});
}

/// A sphere of radius 1 with `rings` parts from pole to pole along y, and `value` of each place.
template <class Value> Mesh sphere(int rings, const Value& value) {
    Mesh mesh;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < 2 * rings; ++j) {
            const double theta = std::numbers::pi * i / rings, phi = std::numbers::pi * j / rings;
            mesh.positions.push_back({std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)});
            mesh.values.push_back(value(mesh.positions.back()));
            const int a = (i - 1) * 2 * rings + j, b = (i - 1) * 2 * rings + (j + 1) % (2 * rings), c = a + 2 * rings, d = b + 2 * rings;
            if (i > 0) mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
        }
    return mesh;
}

/// Points along the lines, at most half a pixel apart.
std::vector<glm::dvec2> points_on(const Lines& lines) {
    std::vector<glm::dvec2> points;
    for (const auto& line : lines)
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            for (double t = 0, step = 0.5 / std::max(0.5, glm::length(line[i + 1] - line[i])); t <= 1; t += step)
                points.push_back(line[i] + t * (line[i + 1] - line[i]));
    return points;
}

double length_of(const std::vector<glm::dvec2>& line) {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i) sum += glm::length(line[i] - line[i - 1]);
    return sum;
}

// The values z + 1/6 are multiples of 1/3 at z = 1/6, 1/2 and 5/6 in front; behind, there are as many.
TEST(VisibleIsolines, OfHeightsOnASphereAreCirclesAndNoneOfTheBack) {
    for (const int rings : {60, 400}) {   // triangles of many pixels, and of half a pixel
        const Mesh mesh = sphere(rings, [](const glm::dvec3& p) { return p.z + 1.0 / 6; });
        const Lines lines = lines_of(mesh, render::view_named("+z"), 1.0 / 3);
        const double radius = 0.92 * 200;
        std::vector<double> radii;
        for (const auto& line : lines) {
            EXPECT_EQ(line.front(), line.back()) << "a closed line";
            radii.push_back(length_of(line) / (2 * std::numbers::pi));
            for (const glm::dvec2& p : points_on({line})) ASSERT_NEAR(glm::length(p - 200.0), radii.back(), rings == 60 ? 0.5 : 0.06);
        }
        std::ranges::sort(radii);
        ASSERT_EQ(radii.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i) {
            const double z = 5.0 / 6 - static_cast<double>(i) / 3;
            EXPECT_NEAR(radii[i], radius * std::sqrt(1 - z * z), rings == 60 ? 0.4 : 0.05);
        }
    }
}

TEST(VisibleIsolines, LieOnMultiplesOfTheSpacing) {
    const Mesh mesh = render_tests::pebble();   // its values are x + y / 2
    const View view = render::view_named("+z");
    const render::Frame frame = render::frame_of(mesh.surface(), view, {.width = 400, .height = 400});
    const Lines lines = lines_of(mesh, view, 30);
    EXPECT_GT(lines.size(), 20U);
    for (const glm::dvec2& p : points_on(lines)) {
        const glm::dvec2 at = glm::dvec2(p.x - 200, 200 - p.y) / frame.pixels_per_unit + glm::dvec2(frame.centre);
        const double multiple = (at.x + 0.5 * at.y) / 30;
        ASSERT_NEAR(multiple, std::round(multiple), 1e-9);
    }
}

// The places of the lines and of the pixels that the isolines of the picture change.
TEST(VisibleIsolines, LieWhereThePictureHasThem) {
    const Mesh mesh = render_tests::pebble();
    for (const char* name : {"+z", "-y", "hero"}) {   // from +x the lines are so dense that the picture fades them
        const View view = render::view_named(name);
        DrawOptions options{.width = 500, .height = 400, .range = {nullptr, -5000, 700}, .shading = false};
        const render::Image plain = render::draw_views(mesh.surface(), std::span(&view, 1), options).front();
        options.isoline_spacing = 60;
        const render::Image lined = render::draw_views(mesh.surface(), std::span(&view, 1), options).front();
        const std::vector<glm::dvec2> points = points_on(render::visible_isolines(mesh.surface(), view, options));
        const auto change = [&](int x, int y) {
            return x < 0 || y < 0 || x >= 500 || y >= 400 ? 0 : std::abs(plain.at(x, y).g - lined.at(x, y).g);
        };
        std::vector<char> near(500 * 400);
        int on_dark = 0, dark = 0, met = 0;
        for (const glm::dvec2& p : points) {
            const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
            int most = 0;
            for (int v = std::max(0, y - 1); v <= std::min(399, y + 1); ++v)
                for (int u = std::max(0, x - 1); u <= std::min(499, x + 1); ++u)
                    most = std::max(most, change(u, v)), near[static_cast<std::size_t>(500 * v + u)] = 1;
            on_dark += most > 20 ? 1 : 0;
        }
        for (int y = 0; y < 400; ++y)
            for (int x = 0; x < 500; ++x)
                if (change(x, y) > 40) ++dark, met += near[static_cast<std::size_t>(500 * y + x)];
        EXPECT_GT(points.size(), 2000U) << name;
        EXPECT_GT(on_dark, 0.9 * static_cast<double>(points.size())) << name << ' ' << on_dark << ' ' << points.size();
        EXPECT_GT(met, 0.97 * dark) << name << ' ' << dark;
    }
}

// Twelve triangles: nearly all of the back share vertices with those in front.
TEST(VisibleIsolines, OfABoxAreOnItsThreeVisibleSides) {
    Mesh mesh = render_tests::box({-1, -1, -1}, {1, 1, 1});
    for (const glm::dvec3& p : mesh.positions) mesh.values.push_back(p.y + 0.5);
    const View hero = render::three_quarter_view();
    const double scale = render::frame_of(mesh.surface(), hero, {.width = 400, .height = 400}).pixels_per_unit;
    double length = 0;
    for (const auto& line : lines_of(mesh, hero, 1)) length += length_of(line);   // at y = ±0.5, on +x and +z
    const auto side = [&](const glm::dvec3& along) {
        return 2 * scale * std::hypot(glm::dot(along, hero.right()), glm::dot(along, hero.up));
    };
    EXPECT_NEAR(length, 2 * (side({1, 0, 0}) + side({0, 0, 1})), 16);
}

/// A square of values y behind a smaller one without values.
Mesh half_hidden() {
    Mesh mesh = render_tests::grid(7);
    const Mesh front = render_tests::grid(3);
    for (const glm::ivec3& t : front.triangles) mesh.triangles.push_back(t + static_cast<int>(mesh.positions.size()));
    for (const glm::dvec3& p : mesh.positions) mesh.values.push_back(p.y + 0.03);
    for (const glm::dvec3& p : front.positions) mesh.positions.push_back({0.5 * p.x, 0.5 * p.y, 0.2}), mesh.values.push_back(std::nan(""));
    return mesh;
}

TEST(VisibleIsolines, EndWhereAnotherSurfaceHidesThem) {
    const double half = 0.92 * 200;
    double length = 0;
    for (const auto& line : lines_of(half_hidden(), render::view_named("+z"), 0.2)) length += length_of(line);
    for (const glm::dvec2& p : points_on(lines_of(half_hidden(), render::view_named("+z"), 0.2)))
        ASSERT_GT(std::max(std::abs(p.x - 200), std::abs(p.y - 200)), half / 2 - 1.6);
    EXPECT_NEAR(length, 10 * 2 * half - 5 * half, 10) << "ten lines, five of them half hidden";
    length = 0;
    for (const auto& line : lines_of(half_hidden(), render::view_named("-z"), 0.2)) length += length_of(line);
    EXPECT_NEAR(length, 10 * 2 * half, 1) << "all are seen from behind";
}

TEST(VisibleIsolines, AreTheSameOfATurnedModelInATurnedView) {
    const Mesh mesh = render_tests::pebble();
    for (const render::Up up : {render::Up::x, render::Up::z}) {
        Mesh turned = mesh;
        for (glm::dvec3& p : turned.positions) p = render::turned_to(up, p);
        for (const render::Angles angles : {render::Angles{0, 0, 0}, {35, 22, 0}, {-110, 40, 15}}) {
            const Lines a = lines_of(mesh, render::view_from(angles), 40), b = lines_of(turned, render::view_from(angles, up), 40);
            ASSERT_EQ(a.size(), b.size());
            for (std::size_t i = 0; i < a.size(); ++i) {
                ASSERT_EQ(a[i].size(), b[i].size());
                for (std::size_t k = 0; k < a[i].size(); ++k) ASSERT_LT(glm::length(a[i][k] - b[i][k]), 1e-9);
            }
        }
    }
}

TEST(VisibleIsolines, DoNotDependOnTheNumberOfThreads) {
    const Mesh mesh = render_tests::pebble();
    const Lines many = lines_of(mesh, render::three_quarter_view(), 10);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(lines_of(mesh, render::three_quarter_view(), 10), many);
}

TEST(VisibleIsolines, NeedASpacingAndValues) {
    Mesh mesh = render_tests::pebble();
    EXPECT_TRUE(lines_of(mesh, render::three_quarter_view(), 0).empty());
    EXPECT_TRUE(lines_of(mesh, render::three_quarter_view(), -1).empty());
    std::ranges::fill(mesh.values, 40);
    EXPECT_TRUE(lines_of(mesh, render::three_quarter_view(), 20).empty()) << "a level without a place";
    mesh.values.clear();
    EXPECT_TRUE(lines_of(mesh, render::three_quarter_view(), 20).empty());
}

}   // namespace
