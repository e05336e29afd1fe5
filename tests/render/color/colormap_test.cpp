#include "color/colormap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "color/evenness.h"
#include "color/srgb.h"
#include "render/color_difference.h"

namespace {

using render::color_at;
using render::Colormap;
using render::lab_of;
using render::Rgba;

// Values of D65 white, black and the primaries as tabled for sRGB (Lindbloom, CIE colour calculator).
TEST(Cielab, KnownColours) {
    const auto expect = [](Rgba c, double L, double a, double b) {
        const glm::dvec3 lab = lab_of(c);
        EXPECT_NEAR(lab.x, L, 0.02);
        EXPECT_NEAR(lab.y, a, 0.02);
        EXPECT_NEAR(lab.z, b, 0.02);
    };
    expect({255, 255, 255, 255}, 100, 0, 0);
    expect({0, 0, 0, 255}, 0, 0, 0);
    expect({255, 0, 0, 255}, 53.24, 80.09, 67.20);
    expect({0, 0, 255, 255}, 32.30, 79.19, -107.86);
    expect({119, 119, 119, 255}, 50.03, 0, 0);
}

TEST(Cielab, ConversionsThereAndBackKeepTheColour) {
    for (int r = 0; r < 256; r += 15)
        for (int g = 0; g < 256; g += 15)
            for (int b = 0; b < 256; b += 15) {
                const Rgba c{static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b), 255};
                ASSERT_EQ(render::rgba_of_lab(lab_of(c)), c);
            }
}

// Pairs of the table of Sharma, Wu and Dalal (2005): each tries a branch of the formula.
TEST(Cielab, Ciede2000AsPublished) {
    struct Pair {
        glm::dvec3 a, b;
        double distance;
    };
    for (const Pair& p : {Pair{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
                          {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0},
                          {{50, 0, 0}, {50, -1, 2}, 2.3669},
                          {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
                          {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
                          {{50, -0.001, 2.49}, {50, 0.0011, -2.49}, 4.7461},
                          {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
                          {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
                          {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
                          {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
                          {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}}) {
        EXPECT_NEAR(render::delta_e_2000(p.a, p.b), p.distance, 5e-5);
        EXPECT_NEAR(render::delta_e_2000(p.b, p.a), p.distance, 5e-5);
    }
    EXPECT_EQ(render::delta_e_2000({40, 10, -20}, {40, 10, -20}), 0);
}

bool is_uniform(const Colormap& map) { return render::unevenness_of(map).empty(); }

TEST(Colormaps, TheMapsNamedInReportsExist) {
    for (const char* name : {"viridis", "pale", "parula-like", "diverging", "magma", "cividis", "grey", "cyclic"})
        EXPECT_EQ(render::colormap_named(name).name, name);
    EXPECT_EQ(render::colormap_named("diverging").kind, "diverging");
    EXPECT_THROW(render::colormap_named("jett"), std::invalid_argument);
}

TEST(Colormaps, AreFoundInAnyCaseAndByOtherNames) {
    EXPECT_EQ(render::find_colormap("rdbu")->name, "RdBu");
    EXPECT_EQ(render::find_colormap("JET")->name, "jet");
    EXPECT_EQ(render::find_colormap("Gray"), render::find_colormap("grey"));
    EXPECT_EQ(render::find_colormap("parula"), render::find_colormap("parula-like"));
    for (const char* other : {"", "vi", "viridiss", "gra", "jet "}) EXPECT_EQ(render::find_colormap(other), nullptr) << other;
    for (const Colormap& map : render::colormap_list()) EXPECT_EQ(render::find_colormap(map.name), &map);
}

// Lighter, or from pale on darker.
TEST(Colormaps, SequentialMapsChangeLightnessEvenly) {
    for (const Colormap& map : render::colormap_list()) {
        if (map.kind != "sequential" || !is_uniform(map)) continue;
        const double L0 = lab_of(color_at(map, 0)).x, L1 = lab_of(color_at(map, 1)).x, way = L1 > L0 ? 1 : -1;
        EXPECT_GT(std::abs(L1 - L0), 55) << map.name;
        double previous = L0;
        for (int i = 1; i <= 32; ++i) {
            const double L = lab_of(color_at(map, i / 32.0)).x;
            ASSERT_GT(way * (L - previous), 0) << map.name << " at " << i / 32.0;
            ASSERT_NEAR(L, L0 + (L1 - L0) * i / 32, 6) << map.name << " at " << i / 32.0;
            previous = L;
        }
    }
}

TEST(Colormaps, PaleIsNearlyWhiteAtZero) {
    const glm::dvec3 zero = lab_of(color_at(render::colormap_named("pale"), 0));
    EXPECT_GT(zero.x, 92);
    EXPECT_LT(std::hypot(zero.y, zero.z), 8);
}

TEST(Colormaps, DivergingIsEquallyLightOnBothSidesOfANeutralMiddle) {
    const Colormap& map = render::colormap_named("diverging");
    const glm::dvec3 middle = lab_of(color_at(map, 0.5));
    EXPECT_GT(middle.x, 90);
    EXPECT_LT(std::hypot(middle.y, middle.z), 2);
    double previous = middle.x;
    for (int i = 1; i <= 32; ++i) {
        const glm::dvec3 below = lab_of(color_at(map, 0.5 - i / 64.0)), above = lab_of(color_at(map, 0.5 + i / 64.0));
        ASSERT_NEAR(below.x, above.x, 1.6) << map.name << " at ±" << i / 64.0;
        ASSERT_LT(below.x, previous);
        previous = below.x;
    }
    EXPECT_LT(lab_of(color_at(map, 0)).z, -30);   // blue
    EXPECT_GT(lab_of(color_at(map, 1)).y, 30);    // red
}

// Pale at 0, dark at ½, and t as light as 1 − t, so that no direction stands out.
TEST(Colormaps, CyclicClosesAndIsEquallyLightInBothDirections) {
    const Colormap& map = render::colormap_named("cyclic");
    EXPECT_EQ(color_at(map, 0), color_at(map, 1));
    for (int i = 0; i < 16; ++i) {
        const double L = lab_of(color_at(map, i / 32.0)).x;
        ASSERT_NEAR(L, lab_of(color_at(map, 1 - i / 32.0)).x, 1) << map.name << " at " << i / 32.0;
        ASSERT_GT(L, lab_of(color_at(map, (i + 1) / 32.0)).x) << map.name << " at " << i / 32.0;
    }
    EXPECT_GT(lab_of(color_at(map, 0)).x - lab_of(color_at(map, 0.5)).x, 45);
}

// The largest of 16 steps over the smallest, by CIEDE2000. Those of matplotlib are even in another space (CAM02-UCS).
TEST(Colormaps, StepsOfPerceptualMapsAreSimilar) {
    for (const Colormap& map : render::colormap_list()) {
        if (!is_uniform(map)) continue;
        double least = 1e9, most = 0;
        for (int i = 0; i < 16; ++i) {
            const double step = render::delta_e_2000(lab_of(color_at(map, i / 16.0)), lab_of(color_at(map, (i + 1) / 16.0)));
            least = std::min(least, step), most = std::max(most, step);
        }
        EXPECT_LT(most / least, map.name == "cyclic" ? 1.2 : map.name == "diverging" ? 1.6 : 2.8) << map.name;
    }
}

TEST(Colormaps, HaveNoJumps) {
    for (const Colormap& map : render::colormap_list())
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 d = lab_of(color_at(map, i / 1000.0)) - lab_of(color_at(map, (i + 1) / 1000.0));
            ASSERT_LT(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), 2.5) << map.name << " at " << i;
        }
}

TEST(ColorAt, IsClampedAndMeetsTheStops) {
    for (const Colormap& map : render::colormap_list()) {
        EXPECT_EQ(color_at(map, -3), map.stops.front());
        EXPECT_EQ(color_at(map, 1e300), map.stops.back());
        EXPECT_EQ(color_at(map, -std::numeric_limits<double>::infinity()), map.stops.front());
        for (std::size_t i = 0; i < map.stops.size(); ++i)
            ASSERT_EQ(color_at(map, static_cast<double>(i) / static_cast<double>(map.stops.size() - 1)), map.stops[i]);
    }
}

}   // namespace
