// Colour maps that can be read as numbers: equal steps of the value are equal steps of CAM02-UCS (Luo, Cui, Li, Uniform colour spaces based
// on CIECAM02, Color Research and Application 31(4), 2006). equal_steps.py made their colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <string>

#include "color/colormap.h"
#include "color/srgb.h"

namespace cam02 {

using glm::dvec3;
using render::Rgba;

namespace {

/// The values of the publication, row by row.
dvec3 times(const std::array<dvec3, 3>& rows, const dvec3& v) { return {glm::dot(rows[0], v), glm::dot(rows[1], v), glm::dot(rows[2], v)}; }

const dvec3 white{95.047, 100, 108.883};
const std::array<dvec3, 3> cat02{{{0.7328, 0.4296, -0.1624}, {-0.7036, 1.6975, 0.0061}, {0.0030, 0.0136, 0.9834}}};
const glm::dmat3 cat02_columns = glm::transpose(glm::dmat3(cat02[0], cat02[1], cat02[2]));
const std::array<dvec3, 3> cones{{{0.38971, 0.68898, -0.07868}, {-0.22981, 1.18340, 0.04641}, {0, 0, 1}}};
const std::array<dvec3, 3> xyz_of_rgb{
    {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};

/// Viewing conditions of sRGB: average surround, ground of 20 %, white of 64 lx.
const double pi = std::acos(-1.0), L_A = 64 / pi / 5, n = 0.2, k = 1 / (5 * L_A + 1);
const double F_L = 0.2 * std::pow(k, 4) * 5 * L_A + 0.1 * std::pow(1 - std::pow(k, 4), 2) * std::cbrt(5 * L_A);
const double N_bb = 0.725 * std::pow(1 / n, 0.2), z = 1.48 + std::sqrt(n), D = 1 - std::exp((-L_A - 42) / 92) / 3.6;

dvec3 responses(const dvec3& xyz) {
    const dvec3 rgb = times(cat02, xyz), rgb_of_white = times(cat02, white);
    dvec3 adapted;
    for (int i = 0; i < 3; ++i) adapted[i] = rgb[i] * (100 * D / rgb_of_white[i] + 1 - D);
    dvec3 p = times(cones, glm::inverse(cat02_columns) * adapted);
    for (int i = 0; i < 3; ++i) {
        const double t = std::pow(F_L * std::abs(p[i]) / 100, 0.42);
        p[i] = std::copysign(400 * t / (t + 27.13), p[i]) + 0.1;
    }
    return p;
}

double achromatic(const dvec3& p) { return (2 * p.x + p.y + p.z / 20 - 0.305) * N_bb; }

/// (J', a', b').
dvec3 cam02_ucs(Rgba c) {
    const dvec3 rgb(render::linear_of(c.r), render::linear_of(c.g), render::linear_of(c.b)), p = responses(100.0 * times(xyz_of_rgb, rgb));
    const double a = p.x - 12 * p.y / 11 + p.z / 11, b = (p.x + p.y - 2 * p.z) / 9, hue = std::atan2(b, a);
    const double J = 100 * std::pow(std::max(0.0, achromatic(p)) / achromatic(responses(white)), 0.69 * z);
    const double t = 50000.0 / 13 * N_bb * 0.25 * (std::cos(hue + 2) + 3.8) * std::hypot(a, b) / (p.x + p.y + 21 * p.z / 20);
    const double M = std::pow(t, 0.9) * std::sqrt(J / 100) * std::pow(1.64 - std::pow(0.29, n), 0.73) * std::pow(F_L, 0.25);
    const double chroma = std::log(1 + 0.0228 * M) / 0.0228;
    return {1.7 * J / (1 + 0.007 * J), chroma * std::cos(hue), chroma * std::sin(hue)};
}

/// The largest of the steps of 5 % between two places over the smallest.
double unevenness(const render::Colormap& map, double low, double high) {
    const int steps = static_cast<int>(std::lround((high - low) / 0.05));
    double least = 1e9, most = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = low + 0.05 * i;
        const double step = glm::length(cam02_ucs(render::color_at(map, t + 0.05)) - cam02_ucs(render::color_at(map, t)));
        least = std::min(least, step), most = std::max(most, step);
    }
    return most / least;
}

// White, black and mid-grey are neutral at J' 100, 0 and about a half.
TEST(Cam02Ucs, KnownColours) {
    EXPECT_NEAR(cam02_ucs({255, 255, 255, 255}).x, 100, 0.01);
    EXPECT_NEAR(cam02_ucs({0, 0, 0, 255}).x, 0, 0.2);
    const dvec3 grey = cam02_ucs({119, 119, 119, 255});
    EXPECT_NEAR(std::hypot(grey.y, grey.z), 0, 1.5);
    EXPECT_NEAR(grey.x, 53, 3);
}

// 8 bits a channel alone make steps of 7 differ by 5 %. Before, 1.5 on either side.
TEST(EqualSteps, DivergingMapsHaveEqualStepsOnEachSide) {
    const render::Colormap& map = render::colormap_named("diverging");
    EXPECT_LT(unevenness(map, 0, 0.5), 1.15);
    EXPECT_LT(unevenness(map, 0.5, 1), 1.15);
    const double below = glm::length(cam02_ucs(render::color_at(map, 0.25)) - cam02_ucs(render::color_at(map, 0)));
    const double above = glm::length(cam02_ucs(render::color_at(map, 1)) - cam02_ucs(render::color_at(map, 0.75)));
    EXPECT_NEAR(below / above, 1, 0.1);   // a value and its negative are as far from the middle
}

// Before, 1.72. Not nearer, or readers without L cones could not tell cream from green (color_vision_test.cpp).
TEST(EqualSteps, Pale) { EXPECT_LT(unevenness(render::colormap_named("pale"), 0, 1), 1.35); }

TEST(EqualSteps, EndsAndMiddleAreKept) {
    const render::Colormap &diverging = render::colormap_named("diverging"), &pale = render::colormap_named("pale");
    EXPECT_EQ(render::color_at(diverging, 0), (Rgba{0x00, 0x4c, 0x9e, 255}));
    EXPECT_EQ(render::color_at(diverging, 0.5), (Rgba{0xee, 0xee, 0xee, 255}));
    EXPECT_EQ(render::color_at(diverging, 1), (Rgba{0x93, 0x23, 0x2b, 255}));
    EXPECT_EQ(render::color_at(pale, 0), (Rgba{0xf1, 0xee, 0xe4, 255}));
    EXPECT_EQ(render::color_at(pale, 1), (Rgba{0x25, 0x32, 0x61, 255}));
}

// The law above is able to fail: the rainbow is far from it.
TEST(EqualSteps, UnevenMapsFailTheTests) { EXPECT_GT(unevenness(render::colormap_named("jet"), 0, 1), 1.5); }

}   // namespace

}   // namespace cam02
