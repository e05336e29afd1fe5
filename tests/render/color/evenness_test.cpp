#include "color/evenness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "color/srgb.h"

namespace {

using render::Colormap;
using render::Rgba;
using render::unevenness_of;

/// A map of equal steps of lightness without colour, along the lightnesses.
Colormap greys(const char* kind, const std::vector<double>& lightnesses) {
    Colormap map{"greys", kind, "", {}};
    for (const double L : lightnesses) map.stops.push_back(render::rgba_of_lab({L, 0, 0}));
    return map;
}

TEST(Evenness, TellsUniformMapsFromOthers) {
    const std::vector<std::string> uneven{"seismic", "turbo", "jet", "rainbow", "hot"};
    for (const Colormap& map : render::colormap_list())
        EXPECT_EQ(unevenness_of(map).empty(), std::ranges::find(uneven, map.name) == uneven.end())
            << map.name << ": " << unevenness_of(map);
    for (const char* name : {"turbo", "jet", "rainbow"})
        EXPECT_EQ(unevenness_of(render::colormap_named(name)), "its lightness goes up and down");
    for (const char* name : {"seismic", "hot"})
        EXPECT_TRUE(unevenness_of(render::colormap_named(name)).starts_with("equal steps look up to ")) << name;
}

TEST(Evenness, OfGreysIsTheRatioOfTheirSteps) {
    EXPECT_EQ(unevenness_of(greys("sequential", {20, 50, 80})), "");
    EXPECT_EQ(unevenness_of(greys("sequential", {80, 50, 20})), "");
    EXPECT_EQ(unevenness_of(greys("sequential", {20, 44, 80})), "");
    const std::string five = unevenness_of(greys("sequential", {20, 30, 80})), start = "equal steps look up to ";
    ASSERT_TRUE(five.starts_with(start));
    EXPECT_NEAR(std::stoi(five.substr(start.size())), 6.5, 1.5);   // 5, and up to 8, because channels have 8 bits
    EXPECT_EQ(unevenness_of(greys("sequential", {20, 50, 50, 50, 80})), "it shows different values in one colour");
    EXPECT_EQ(unevenness_of(greys("sequential", {50, 50})), "it shows different values in one colour");
}

TEST(Evenness, LightnessMayTurnInTheMiddleOfADivergingMapOnly) {
    EXPECT_EQ(unevenness_of(greys("diverging", {20, 80, 20})), "");
    EXPECT_EQ(unevenness_of(greys("diverging", {80, 20, 80})), "");
    EXPECT_EQ(unevenness_of(greys("sequential", {20, 80, 20})), "its lightness goes up and down");
    EXPECT_EQ(unevenness_of(greys("diverging", {20, 50, 80, 50, 20, 50, 80, 50, 20})),
              "its lightness goes up and down on one side of the middle");
}

TEST(Evenness, CyclicMapsClose) {
    EXPECT_EQ(unevenness_of(greys("cyclic", {20, 80, 20})), "");
    EXPECT_EQ(unevenness_of(greys("cyclic", {20, 50, 80})), "its ends have different colours");
}

TEST(Kind, IsSeenFromTheColours) {
    for (const Colormap& map : render::colormap_list()) EXPECT_EQ(render::kind_of(map.stops), map.kind) << map.name;
    std::vector<Rgba> off_middle = render::colormap_named("vik").stops;
    off_middle.resize(off_middle.size() * 3 / 4);
    EXPECT_EQ(render::kind_of(off_middle), "sequential");
}

}   // namespace
