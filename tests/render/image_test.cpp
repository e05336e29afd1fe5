#include "image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "srgb.h"

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

/// In double; alpha times colour.
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

TEST(Shrink, OneColourStaysAndHalvingAveragesFourPixels) {
    const Rgba color{200, 13, 77, 255};
    for (const Rgba p : render::shrink(Image(31, 17, color), 10, 9).pixels) EXPECT_EQ(p, color);
    Image checks(2, 2, {0, 0, 0, 255});
    checks.at(0, 0) = checks.at(1, 1) = {255, 255, 255, 255};
    EXPECT_EQ(render::shrink(checks, 1, 1).at(0, 0), (Rgba{188, 188, 188, 255}));
}

TEST(Shrink, TransparentPixelsLendNoColour) {
    Image image(2, 1, {255, 0, 0, 255});
    image.at(1, 0) = {0, 255, 0, 0};
    EXPECT_EQ(render::shrink(image, 1, 1).at(0, 0), (Rgba{255, 0, 0, 128}));
}

TEST(Shrink, RefusesToEnlarge) {
    EXPECT_THROW(render::shrink(Image(5, 5), 6, 5), std::invalid_argument);
    EXPECT_THROW(render::shrink(Image(5, 5), 0, 5), std::invalid_argument);
    EXPECT_EQ(render::shrink(noise(5, 4, false, 2), 5, 4).pixels, noise(5, 4, false, 2).pixels);
}

TEST(Paste, CutsOffWhatHangsOver) {
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
