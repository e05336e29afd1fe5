#include "scene/occlusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "color/srgb.h"
#include "render/shapes.h"

namespace {

using render::HeightField;
using render::Sky;

constexpr int field_side = 240;

HeightField field_of(const std::function<double(double, double)>& height) {
    HeightField field(field_side, field_side);
    std::vector<float> row(field_side);
    for (int y = 0; y < field_side; ++y) {
        for (int x = 0; x < field_side; ++x)
            row[static_cast<std::size_t>(x)] = static_cast<float>(height(x - field_side / 2, y - field_side / 2));
        field.set(0, y, row);
    }
    return field;
}

float openness_at(const HeightField& field, int x, int y) {
    std::vector<float> row(field_side);
    Sky(field).openness(0, field_side / 2 + y, row);
    return row[static_cast<std::size_t>(field_side / 2 + x)];
}

TEST(Occlusion, PlanesSeeTheWholeSkyHoweverInclined) {
    for (const double slope : {0.0, 0.3, 1.0, 4.0}) {
        const HeightField plane = field_of([&](double x, double y) { return slope * x - 0.5 * slope * y; });
        EXPECT_NEAR(double(openness_at(plane, 0, 0)), 1, 1e-5) << slope;
    }
}

TEST(Occlusion, RidgesAndBallsSeeTheWholeSkyToo) {
    EXPECT_NEAR(double(openness_at(field_of([](double x, double) { return -std::abs(x); }), 0, 0)), 1, 1e-5);
    const HeightField ball = field_of([](double x, double y) { return std::sqrt(std::max(0.0, 10000 - x * x - y * y)); });
    for (const int x : {0, 20, 50, 80}) EXPECT_NEAR(double(openness_at(ball, x, 0)), 1, 1e-5) << x;
}

TEST(Occlusion, TheNarrowerAValleyTheDarkerItsBottom) {
    float before = 1;
    for (const double slope : {0.4, 0.8, 1.5, 3.0}) {
        const float open = openness_at(field_of([&](double x, double) { return slope * std::abs(x); }), 0, 0);
        EXPECT_LT(open, before - 0.03F) << slope;
        before = open;
    }
}

TEST(Occlusion, APitIsDarkerThanAValleyAndItsRimIsLight) {
    const HeightField valley = field_of([](double x, double) { return 0.02 * x * x; });
    const HeightField pit = field_of([](double x, double y) { return 0.02 * (x * x + y * y); });
    EXPECT_LT(openness_at(pit, 0, 0), openness_at(valley, 0, 0) - 0.02F);
    const HeightField hole = field_of([](double x, double y) { return x * x + y * y < 64 ? -8 : 0; });
    EXPECT_LT(openness_at(hole, 0, 0), 0.6F);
    EXPECT_GT(openness_at(hole, 60, 0), 0.999F);
}

TEST(Occlusion, DoesNotDependOnHeightOrSide) {
    const auto hill = [](double x, double y) { return 6 * std::sin(0.13 * x) * std::cos(0.11 * y); };
    const HeightField here = field_of(hill), higher = field_of([&](double x, double y) { return hill(x, y) + 64; });
    const HeightField turned = field_of([&](double x, double y) { return hill(-x, -y); });
    for (const int x : {-40, -7, 0, 13, 55}) {
        EXPECT_NEAR(double(openness_at(here, x, 9)), double(openness_at(higher, x, 9)), 1e-4);
        EXPECT_EQ(openness_at(here, x, 9), openness_at(turned, -x, -9));
    }
}

// Another part far in front is not a wall of the same hollow; without this, silhouettes would have dark haloes.
TEST(Occlusion, PartsFarInFrontCastNoShade) {
    const auto step = [](double height) { return field_of([=](double x, double) { return x > 3 ? height : 0; }); };
    EXPECT_LT(openness_at(step(6), 0, 0), 0.9F);
    EXPECT_GT(openness_at(step(200), 0, 0), 0.999F);
}

TEST(Occlusion, EmptyPixelsAroundASurfaceHideNoSky) {
    const HeightField strip = field_of([](double x, double) { return std::abs(x) < 4 ? 0 : double(HeightField::nothing); });
    EXPECT_EQ(openness_at(strip, 0, 0), 1);
    std::vector<float> row(field_side);
    Sky(HeightField(field_side, field_side)).openness(0, 5, row);
    for (const float open : row) ASSERT_EQ(open, 1);
}

TEST(Occlusion, DarkensColoursWithoutShiftingTheirHue) {
    render_tests::Mesh mesh = render_tests::grid(120);
    for (glm::dvec3& p : mesh.positions) {
        p.z = 0.06 * std::sin(26 * p.x) * std::cos(24 * p.y);
        mesh.values.push_back(p.x);
    }
    render::DrawOptions options{.width = 200, .height = 200, .range = {nullptr, -1, 1}};
    const auto with = render::draw_views(mesh.surface(), render::six_views, options)[4];
    options.occlusion = false;
    const auto without = render::draw_views(mesh.surface(), render::six_views, options)[4];
    int darker = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) {
        const render::LinearColor a = render::linear_of(with.pixels[i]), b = render::linear_of(without.pixels[i]);
        ASSERT_LE(a.r + a.g + a.b, b.r + b.g + b.b + 0.02F);
        darker += a.g < 0.97F * b.g ? 1 : 0;
        ASSERT_NEAR(double(a.r * b.g), double(a.g * b.r), 0.012);   // the ratio of channels stays, up to rounding to 8 bits
        ASSERT_NEAR(double(a.b * b.g), double(a.g * b.b), 0.012);
    }
    EXPECT_GT(darker, 100);
}

}   // namespace
