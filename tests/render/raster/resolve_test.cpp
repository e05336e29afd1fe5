#include "raster/resolve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "render/shapes.h"

namespace {

using render::Layer;
using render::LinearColor;
using render::Rgba;

std::vector<LinearColor> random_surfaces(std::size_t count) {
    std::mt19937_64 random(3);
    std::vector<LinearColor> surfaces(count);
    for (LinearColor& c : surfaces) {
        const auto channel = [&] { return static_cast<float>(render_tests::random_integer(random, 0, 1000)) / 1000; };
        c.a = static_cast<float>(render_tests::random_integer(random, 0, 4)) / 4;
        c.r = c.a * channel(), c.g = c.a * channel(), c.b = c.a * channel();
    }
    return surfaces;
}

// Lengths round whole vectors: the rest of a row goes another way through the code.
TEST(Resolve, CompositesOverTheBackgroundForEveryLength) {
    const std::vector<LinearColor> all = random_surfaces(70);
    for (const Rgba background : {Rgba{255, 255, 255, 255}, Rgba{30, 60, 90, 255}, Rgba{255, 255, 255, 0}, Rgba{10, 20, 30, 128}})
        for (std::size_t count = 0; count <= all.size(); ++count) {
            std::vector<Rgba> pixels(count + 1, Rgba{1, 2, 3, 4});
            render::resolve(std::span(all).first(count), background, std::span(pixels).first(count));
            for (std::size_t i = 0; i < count; ++i) {
                LinearColor expected = all[i];
                expected += (1 - expected.a) * render::linear_of(background);
                ASSERT_EQ(pixels[i], all[i].a == 0 ? background : render::srgb_of(expected)) << i << " of " << count;
            }
            ASSERT_EQ(pixels[count], (Rgba{1, 2, 3, 4})) << "wrote beyond " << count;
        }
}

TEST(Resolve, UnpackedLayersAreMultipliedByTheirLightForEveryLength) {
    const std::vector<LinearColor> all = random_surfaces(70);
    std::vector<float> lights(all.size());
    for (std::size_t i = 0; i < lights.size(); ++i) lights[i] = 0.4F + 0.6F * static_cast<float>(i) / 69;
    for (std::size_t count = 0; count <= all.size(); ++count) {
        std::vector<Layer> layers(count + 1, Layer{7, 7, 7, 7});
        std::vector<LinearColor> surfaces(count + 1, LinearColor{9, 9, 9, 9});
        render::pack(std::span(all).first(count), std::span(layers).first(count));
        render::unpack(std::span(layers).first(count), std::span(lights).first(count), std::span(surfaces).first(count));
        for (std::size_t i = 0; i < count; ++i) {
            const double light = double(lights[i]);
            ASSERT_NEAR(double(surfaces[i].r), light * double(all[i].r), 1e-5) << i << " of " << count;
            ASSERT_NEAR(double(surfaces[i].b), light * double(all[i].b), 1e-5);
            ASSERT_NEAR(double(surfaces[i].a), double(all[i].a), 1e-5);
        }
        ASSERT_EQ(layers[count].r, 7) << "wrote beyond " << count;
        ASSERT_EQ(surfaces[count].r, 9) << "wrote beyond " << count;
    }
}

// Coverage of 0 and 1 survives exactly: no seam of the background shows inside a surface.
TEST(Resolve, CoverageSurvivesPacking) {
    for (const float a : {0.0F, 1.0F}) {
        const std::vector<LinearColor> in(5, LinearColor{0, 0, 0, a});
        std::vector<Layer> layers(5);
        std::vector<LinearColor> out(5);
        render::pack(in, layers);
        render::unpack(layers, std::vector<float>(5, 1.0F), out);
        for (const LinearColor& c : out) EXPECT_EQ(c.a, a);
    }
}

}   // namespace
