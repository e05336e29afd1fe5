// Colour maps of other programs, compared with their formulas and their published colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

#include "color/colormap.h"
#include "color/srgb.h"
#include "render/color_difference.h"

namespace {

using render::color_at;
using render::delta_e_2000;
using render::lab_of;
using render::Rgba;

constexpr double just_different = 3;   // CIEDE2000, between colours that do not touch

Rgba rgba(double r, double g, double b) {
    const auto channel = [](double x) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0))); };
    return {channel(r), channel(g), channel(b), 255};
}

void expect_map(const std::string& name, const std::function<glm::dvec3(double)>& lab_at) {
    for (int i = 0; i <= 200; ++i) {
        const double t = i / 200.0;
        ASSERT_LT(delta_e_2000(lab_of(color_at(render::colormap_named(name), t)), lab_at(t)), just_different) << name << " at " << t;
    }
}

TEST(KnownMaps, FollowTheirFormulas) {
    const double pi = std::acos(-1.0);
    expect_map("jet",
               [](double t) { return lab_of(rgba(1.5 - std::abs(4 * t - 3), 1.5 - std::abs(4 * t - 2), 1.5 - std::abs(4 * t - 1))); });
    expect_map("hot", [](double t) { return lab_of(rgba(8 * t / 3, 8 * t / 3 - 1, 4 * t - 3)); });
    expect_map("rainbow", [pi](double t) { return lab_of(rgba(std::abs(2 * t - 0.5), std::sin(pi * t), std::cos(pi * t / 2))); });
    expect_map("seismic", [](double t) {
        if (t < 0.5) return lab_of(rgba(4 * t - 1, 4 * t - 1, 0.3 + 2.8 * t));
        return lab_of(rgba(t < 0.75 ? 1 : 2.5 - 2 * t, 3 - 4 * t, 3 - 4 * t));
    });
}

/// Magnitude, saturation and hue (Moreland, Diverging Color Maps for Scientific Visualization, 2009).
struct Msh {
    double M, s, h;
};

Msh msh_of(const glm::dvec3& lab) { return {glm::length(lab), std::acos(lab.x / glm::length(lab)), std::atan2(lab.z, lab.y)}; }

TEST(KnownMaps, CoolwarmIsThatOfMoreland) {
    const double middle = 88;
    expect_map("coolwarm", [&](double t) {
        const Msh end = msh_of(lab_of(t < 0.5 ? Rgba{59, 76, 192, 255} : Rgba{180, 4, 38, 255}));
        const double u = 1 - std::abs(2 * t - 1), spin = end.s * std::sqrt(middle * middle - end.M * end.M) / (end.M * std::sin(end.s));
        const double M = end.M + u * (middle - end.M), s = (1 - u) * end.s;
        const double h = end.h + u * (end.h > -std::acos(-1.0) / 3 ? spin : -spin);
        return glm::dvec3(M * std::cos(s), M * std::sin(s) * std::cos(h), M * std::sin(s) * std::sin(h));
    });
}

// Colours at 1/16, 5/16, 11/16 and 15/16, most of them between the colours of the table, in matplotlib 3.6 and Crameri's maps 7.0.
TEST(KnownMaps, HaveTheirPublishedColours) {
    struct Known {
        const char* name;
        std::array<Rgba, 4> colors;
    };
    for (const Known& known : {Known{"viridis", {{{0x48, 0x18, 0x6a}, {0x33, 0x63, 0x8d}, {0x3e, 0xbc, 0x74}, {0xd5, 0xe2, 0x1a}}}},
                               Known{"inferno", {{{0x0b, 0x07, 0x24}, {0x70, 0x19, 0x6e}, {0xf1, 0x71, 0x1e}, {0xf2, 0xe8, 0x65}}}},
                               Known{"plasma", {{{0x31, 0x05, 0x96}, {0x95, 0x11, 0xa2}, {0xf0, 0x7f, 0x4f}, {0xf9, 0xdd, 0x25}}}},
                               Known{"cividis", {{{0x00, 0x2e, 0x6a}, {0x52, 0x59, 0x6d}, {0xab, 0xa0, 0x72}, {0xef, 0xd7, 0x48}}}},
                               Known{"twilight", {{{0xc3, 0xce, 0xd4}, {0x5e, 0x51, 0xad}, {0x98, 0x35, 0x50}, {0xd8, 0xc6, 0xbd}}}},
                               Known{"vik", {{{0x02, 0x2b, 0x71}, {0x60, 0x9d, 0xbc}, {0xcf, 0x8d, 0x67}, {0x74, 0x15, 0x06}}}},
                               Known{"batlow", {{{0x0d, 0x31, 0x5d}, {0x35, 0x6a, 0x59}, {0xdc, 0x95, 0x4c}, {0xfc, 0xbf, 0xd6}}}},
                               Known{"RdBu", {{{0x96, 0x0f, 0x27}, {0xf5, 0xac, 0x8b}, {0x9a, 0xc9, 0xe0}, {0x17, 0x52, 0x90}}}},
                               Known{"turbo", {{{0x40, 0x40, 0xa1}, {0x18, 0xdc, 0xc3}, {0xfd, 0xae, 0x35}, {0xac, 0x17, 0x01}}}}})
        for (std::size_t i = 0; i < 4; ++i) {
            const double t = std::array{1, 5, 11, 15}[i] / 16.0;
            EXPECT_LT(delta_e_2000(lab_of(color_at(render::colormap_named(known.name), t)), lab_of(known.colors[i])), just_different)
                << known.name << " at " << t;
        }
}

}   // namespace
