#include "scene/image.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "color/srgb.h"

namespace {

using render::Image;
using render::linear_of;
using render::LinearColor;
using render::Rgba;

Image noise(int width, int height, bool opaque, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Image image(width, height);
    for (Rgba& p : image.pixels) {
        const std::uint64_t bits = random();
        p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8), static_cast<std::uint8_t>(bits >> 16),
             opaque ? std::uint8_t{255} : static_cast<std::uint8_t>(bits >> 24)};
    }
    return image;
}

/// Computed in double, with the colour multiplied by alpha.
struct Mean {
    double r = 0, g = 0, b = 0, a = 0;
};

Mean mean_light(const Image& image) {
    Mean m;
    for (const Rgba p : image.pixels) {
        const LinearColor c = linear_of(p);
        m.r += static_cast<double>(c.r), m.g += static_cast<double>(c.g), m.b += static_cast<double>(c.b), m.a += static_cast<double>(c.a);
    }
    const auto n = static_cast<double>(image.pixels.size());
    return {m.r / n, m.g / n, m.b / n, m.a / n};
}

TEST(Srgb, EveryChannelSurvivesLinearLight) {
    for (int c = 0; c < 256; ++c) EXPECT_EQ(render::srgb_of(linear_of(static_cast<std::uint8_t>(c))), c);
}

TEST(Srgb, AgreesWithTheStandard) {
    EXPECT_NEAR(linear_of(std::uint8_t{188}), 0.5029F, 1e-4F);
    EXPECT_NEAR(linear_of(std::uint8_t{10}), 10 / 255.0F / 12.92F, 1e-6F);
    EXPECT_EQ(render::srgb_of(0.5F), 188);   // half the light, not half the number
    EXPECT_EQ(render::srgb_of(-1.0F), 0);
    EXPECT_EQ(render::srgb_of(7.0F), 255);
}

TEST(Shrink, KeepsTheMeanInLinearLight) {
    for (const bool opaque : {true, false}) {
        const Image image = noise(97, 61, opaque, 1);
        for (const auto& [width, height] : {std::pair{40, 30}, {97, 7}, {1, 1}, {96, 60}, {33, 61}}) {
            const Mean before = mean_light(image), after = mean_light(render::shrink(image, width, height));
            EXPECT_NEAR(before.r, after.r, 2e-3) << width;
            EXPECT_NEAR(before.g, after.g, 2e-3) << width;
            EXPECT_NEAR(before.b, after.b, 2e-3) << width;
            EXPECT_NEAR(before.a, after.a, 2e-3) << width;
        }
    }
}

/// Flat rectangles, some transparent, with a little noise: stretches of one colour, their edges, and pixels of all kinds.
Image patches(int width, int height, bool opaque, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
    const auto byte = [&] { return static_cast<std::uint8_t>(random()); };
    Image image(width, height);
    for (int patch = 0; patch < 9; ++patch) {
        const int x0 = below(width), y0 = below(height), x1 = x0 + below(width - x0), y1 = y0 + below(height - y0);
        const Rgba color{byte(), byte(), byte(), opaque ? std::uint8_t{255} : patch % 3 == 0 ? std::uint8_t{0} : byte()};
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) image.at(x, y) = color;
    }
    const Image specks = noise(width, height, opaque, seed);
    for (int i = 0; i < 20; ++i) {
        const auto at = static_cast<std::size_t>(below(width * height));
        image.pixels[at] = specks.pixels[at];
    }
    return image;
}

/// Light over the rectangle [x0, x1) × [y0, y1) of the old picture's plane, divided by its area.
Mean area_mean(const Image& image, double x0, double x1, double y0, double y1) {
    Mean m;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double w = std::max(0.0, std::min<double>(x1, x + 1) - std::max<double>(x0, x)) *
                             std::max(0.0, std::min<double>(y1, y + 1) - std::max<double>(y0, y)) / ((x1 - x0) * (y1 - y0));
            const LinearColor c = linear_of(image.at(x, y));
            m.r += w * static_cast<double>(c.r), m.g += w * static_cast<double>(c.g);
            m.b += w * static_cast<double>(c.b), m.a += w * static_cast<double>(c.a);
        }
    return m;
}

TEST(Shrink, EveryPixelIsTheMeanOfItsArea) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const Image image = patches(150, 37, seed % 2 == 0, seed);
        for (const auto& [width, height] : {std::pair{60, 20}, {149, 37}, {75, 12}, {7, 36}}) {
            const Image small = render::shrink(image, width, height);
            for (int y = 0; y < height; y += 3)
                for (int x = 0; x < width; ++x) {
                    const Mean m = area_mean(image, 150.0 * x / width, 150.0 * (x + 1) / width, 37.0 * y / height, 37.0 * (y + 1) / height);
                    const LinearColor c = linear_of(small.at(x, y));
                    // half a step of 8 bits is 0.0045 of the light of white, in the alpha 0.002
                    ASSERT_NEAR(static_cast<double>(c.r), m.r, 0.0068) << seed << " " << x << " " << y;
                    ASSERT_NEAR(static_cast<double>(c.g), m.g, 0.0068) << seed << " " << x << " " << y;
                    ASSERT_NEAR(static_cast<double>(c.b), m.b, 0.0068) << seed << " " << x << " " << y;
                    ASSERT_NEAR(static_cast<double>(c.a), m.a, 0.0021) << seed << " " << x << " " << y;
                }
        }
    }
}

TEST(Shrink, GivesTheSameBytesOnAnyNumberOfThreads) {
    const Image image = patches(600, 400, false, 5);
    const Image expected = render::shrink(image, 211, 97);
    for (const std::size_t threads : {1, 2, 5}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_EQ(render::shrink(image, 211, 97).pixels, expected.pixels);
    }
}

TEST(Shrink, OneColourStaysAndHalvingAveragesFourPixels) {
    const Rgba color{200, 13, 77, 255};
    for (const Rgba p : render::shrink(Image(31, 17, color), 10, 9).pixels) EXPECT_EQ(p, color);
    for (const Rgba p : render::shrink(Image(310, 17, {200, 13, 77, 99}), 77, 9).pixels) EXPECT_EQ(p, (Rgba{200, 13, 77, 99}));
    Image checks(2, 2, {0, 0, 0, 255});
    checks.at(0, 0) = checks.at(1, 1) = {255, 255, 255, 255};
    EXPECT_EQ(render::shrink(checks, 1, 1).at(0, 0), (Rgba{188, 188, 188, 255}));
}

TEST(Shrink, TransparentPixelsAddNoColour) {
    Image image(2, 1, {255, 0, 0, 255});
    image.at(1, 0) = {0, 255, 0, 0};
    EXPECT_EQ(render::shrink(image, 1, 1).at(0, 0), (Rgba{255, 0, 0, 128}));
}

TEST(Shrink, AnEdgeToATransparentPartKeepsItsColour) {
    Image image(200, 40, {0, 255, 0, 0});
    for (int y = 0; y < 40; ++y)
        for (int x = 51; x < 151; ++x) image.at(x, y) = {255, 0, 0, 255};
    for (const Rgba p : render::shrink(image, 61, 13).pixels)
        if (p.a > 0) {
            EXPECT_EQ(p, (Rgba{255, 0, 0, p.a}));
        }
}

TEST(Shrink, RefusesToEnlarge) {
    EXPECT_THROW(render::shrink(Image(5, 5), 6, 5), std::invalid_argument);
    EXPECT_THROW(render::shrink(Image(5, 5), 0, 5), std::invalid_argument);
    EXPECT_EQ(render::shrink(noise(5, 4, false, 2), 5, 4).pixels, noise(5, 4, false, 2).pixels);
}

TEST(Paste, CutsOffPartsBeyondTheTarget) {
    const Image source = noise(8, 6, true, 3);
    for (const auto& [x, y] : {std::pair{-3, -2}, {5, 4}, {-20, 0}, {0, 100}, {1, 1}}) {
        Image target(10, 9, {9, 9, 9, 255});
        render::paste(target, source, x, y);
        for (int v = 0; v < 9; ++v)
            for (int u = 0; u < 10; ++u) {
                const bool inside = u >= x && u < x + 8 && v >= y && v < y + 6;
                ASSERT_EQ(target.at(u, v), inside ? source.at(u - x, v - y) : (Rgba{9, 9, 9, 255}));
            }
    }
}

/// A row is copied whole where it is opaque; that must not show.
TEST(Paste, EveryPixelIsCompositedSeparately) {
    const Image source = patches(90, 30, false, 8), ground = noise(90, 30, false, 9);
    Image whole = ground;
    render::paste(whole, source, 0, 0);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 90; ++x) {
            Image one(1, 1, ground.at(x, y));
            render::paste(one, Image(1, 1, source.at(x, y)), 0, 0);
            ASSERT_EQ(whole.at(x, y), one.at(0, 0)) << x << " " << y;
        }
}

TEST(Paste, CompositesInLinearLight) {
    Image target(3, 1);
    Image source(3, 1);
    source.pixels = {{0, 0, 0, 0}, {0, 0, 0, 128}, {0, 0, 0, 255}};
    render::paste(target, source, 0, 0);
    EXPECT_EQ(target.at(0, 0), (Rgba{255, 255, 255, 255}));
    EXPECT_EQ(target.at(1, 0), (Rgba{187, 187, 187, 255}));   // 127/255 of the light of white
    EXPECT_EQ(target.at(2, 0), (Rgba{0, 0, 0, 255}));
}

}   // namespace
