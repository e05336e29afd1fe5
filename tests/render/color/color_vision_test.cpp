// Colour maps in the sight of readers without L, M or S cones. The matrices of Machado, Oliveira and Fernandes (A Physiologically-based
// Model for Simulation of Color Vision Deficiency, IEEE TVCG 15(6), 2009) for severity 1 simulate it in linear RGB. Distances are
// CIEDE2000, with 1 just visible between patches side by side. The tests ask for several times as much, because colours on a surface are
// shaded and apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "color/colormap.h"
#include "color/evenness.h"
#include "color/srgb.h"
#include "draw_mesh.h"
#include "render/color_difference.h"

namespace {

using render::color_at;
using render::Colormap;
using render::delta_e_2000;
using render::lab_of;
using render::Rgba;

struct Sight {
    std::string_view name;
    glm::dmat3 transposed;   // as printed, row by row
};

const std::array<Sight, 4> sights{
    {{"normal", glm::dmat3(1)},
     {"protanopia", {0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998}},
     {"deuteranopia", {0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881}},
     {"tritanopia", {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900}}}};

Rgba seen_with(const Sight& sight, Rgba c) {
    const glm::vec3 rgb = glm::vec3(glm::dvec3(render::linear_of(c.r), render::linear_of(c.g), render::linear_of(c.b)) * sight.transposed);
    return {render::srgb_of(rgb.r), render::srgb_of(rgb.g), render::srgb_of(rgb.b), c.a};
}

/// CIELAB at t as it is seen.
using Curve = std::function<glm::dvec3(double)>;

Curve curve_of(const Colormap& map, const Sight& sight) {
    return [map, &sight](double t) { return lab_of(seen_with(sight, color_at(map, t))); };
}

/// The least distance between places of the map that lie `apart` or more from one another, on the circle when it is closed.
double least_distance(const Curve& at, double apart, bool is_closed) {
    constexpr int places = 48;
    double least = 1e9;
    for (int i = 0; i <= places; ++i)
        for (int j = 0; j < i; ++j) {
            const double along = double(i - j) / places, gap = is_closed ? std::min(along, 1 - along) : along;
            if (gap >= apart - 1e-9) least = std::min(least, delta_e_2000(at(double(i) / places), at(double(j) / places)));
        }
    return least;
}

/// Calls law(map as it is seen) for every sequential map that is uniform, or for the project's own map of the other kinds: vik, coolwarm
/// and twilight promise less.
void for_every(std::string_view kind, const std::function<void(const Curve&)>& law) {
    int maps = 0;
    for (const Colormap& map : render::colormap_list())
        for (const Sight& sight : sights) {
            if (map.kind != kind || !render::unevenness_of(map).empty() || (kind != "sequential" && map.name != kind)) continue;
            SCOPED_TRACE(std::string(map.name) + " with " + std::string(sight.name));
            law(curve_of(map, sight));
            ++maps;
        }
    EXPECT_GE(maps, 4);
}

TEST(ColorVision, SimulationKeepsGreyAndConfusesTheColoursOfTheMissingCones) {
    const Rgba grey{120, 120, 120, 255}, red{196, 98, 70, 255}, green{110, 134, 66, 255}, blue{0, 120, 142, 255}, teal{0, 126, 116, 255};
    for (const Sight& sight : sights) EXPECT_LT(delta_e_2000(lab_of(seen_with(sight, grey)), lab_of(grey)), 0.1) << sight.name;
    const auto share_left = [](const Sight& sight, Rgba a, Rgba b) {
        return delta_e_2000(lab_of(seen_with(sight, a)), lab_of(seen_with(sight, b))) / delta_e_2000(lab_of(a), lab_of(b));
    };
    EXPECT_LT(share_left(sights[2], red, green), 0.4);
    EXPECT_GT(share_left(sights[3], red, green), 0.8);
    EXPECT_LT(share_left(sights[3], blue, teal), 0.6);
    EXPECT_GT(share_left(sights[2], blue, teal), 0.75);
}

// Nine colours from end to end, as a legend would name them: any two differ by 3.9 or more (least: plasma without L cones; the violet end
// of viridis, 4.6; others above 5), and their order is that of lightness.
TEST(ColorVision, SequentialMapsKeepTheirOrderAndNinePlacesApart) {
    for_every("sequential", [](const Curve& at) {
        EXPECT_GE(least_distance(at, 1 / 8.0, false), 3.9);
        const double way = at(1).x > at(0).x ? 1 : -1;   // lighter, or from pale on darker
        for (int i = 0; i < 16; ++i) EXPECT_GT(way * (at((i + 1) / 16.0).x - at(i / 16.0).x), 0.5) << i;
    });
}

// The middle is the lightest; values of opposite sign differ in hue from an eighth of the range on.
TEST(ColorVision, DivergingMapsKeepTheSignApart) {
    for_every("diverging", [](const Curve& at) {
        EXPECT_GE(least_distance(at, 1 / 8.0, false), 8);
        for (int i = 0; i < 16; ++i) {
            EXPECT_LT(at((15 - i) / 32.0).x, at((16 - i) / 32.0).x) << i;
            EXPECT_LT(at((17 + i) / 32.0).x, at((16 + i) / 32.0).x) << i;
        }
        for (int i = 4; i <= 16; ++i) {
            const glm::dvec3 below = at(0.5 - i / 32.0), above = at(0.5 + i / 32.0);
            EXPECT_GE(delta_e_2000(below, above), 15) << i;
            EXPECT_LT(below.y * above.y + below.z * above.z, 0) << i;   // more than 90° of hue
        }
    });
}

// A sixth of a turn is never mistaken, a sixteenth is visible, and the two directions look different.
TEST(ColorVision, CyclicMapsTellEveryPhase) {
    for_every("cyclic", [](const Curve& at) {
        EXPECT_GE(least_distance(at, 1 / 6.0, true), 14);
        EXPECT_GE(least_distance(at, 1 / 16.0, true), 5);
    });
}

// Neutral and quiet, and yet no value looks like it; for readers without S cones the light blues of pale come nearest, and its hatch tells.
TEST(ColorVision, TheUndefinedColourIsNoColourOfAMap) {
    const Rgba undefined = render::DrawOptions().undefined_color;
    EXPECT_LT(std::hypot(lab_of(undefined).y, lab_of(undefined).z), 1);
    for (const char* name : {"diverging", "pale"})
        for (const Sight& sight : sights) {
            const Curve at = curve_of(render::colormap_named(name), sight);
            const glm::dvec3 seen = lab_of(seen_with(sight, undefined));
            double least = 1e9;
            for (int i = 0; i <= 200; ++i) least = std::min(least, delta_e_2000(seen, at(i / 200.0)));
            EXPECT_GE(least, sight.name == "tritanopia" ? 3.5 : 6.5) << name << " with " << sight.name;
        }
}

// The tests above can fail: a rainbow is not safe, and neither are green and red of equal lightness.
TEST(ColorVision, UnsafeMapsFailTheTests) {
    const std::vector<Rgba> traffic{{0, 128, 62, 255}, {238, 238, 238, 255}, {190, 74, 60, 255}};
    const Curve rainbow = curve_of(render::colormap_named("jet"), sights[2]);
    int falls = 0;
    for (int i = 0; i < 16; ++i) falls += rainbow((i + 1) / 16.0).x < rainbow(i / 16.0).x ? 1 : 0;
    EXPECT_GT(falls, 3);
    const Curve lights = curve_of({"traffic", "diverging", "", traffic}, sights[2]);
    EXPECT_LT(delta_e_2000(lights(0.375), lights(0.625)), 15);
}

}   // namespace
