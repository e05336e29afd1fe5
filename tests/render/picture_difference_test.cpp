#include "render/picture_difference.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "color/colormap.h"
#include "color/srgb.h"
#include "render/color_difference.h"

namespace {

using render::Image;
using render::picture_difference;
using render::PictureDifference;
using render::Rgba;

Image gradient() {
    Image image(40, 20);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x) image.at(x, y) = {static_cast<std::uint8_t>(6 * x), static_cast<std::uint8_t>(12 * y), 90, 255};
    return image;
}

TEST(PictureDifference, EqualPicturesHaveNoDifferenceAndAGreyMap) {
    const PictureDifference d = picture_difference(gradient(), gradient());
    EXPECT_EQ(d.mean, 0);
    EXPECT_EQ(d.largest, 0);
    EXPECT_EQ(d.share, 0);
    for (const Rgba p : d.picture.pixels) {
        EXPECT_EQ(p.r, p.g);
        EXPECT_EQ(p.g, p.b);
        EXPECT_GT(p.r, 170);
    }
}

TEST(PictureDifference, CountsAndShowsPixelsAboveTheThreshold) {
    const Image a = gradient();
    Image b = a;
    b.at(3, 2) = {255, 255, 255, 255};
    b.at(30, 10).r = static_cast<std::uint8_t>(b.at(30, 10).r + 1);   // not seen
    const PictureDifference d = picture_difference(a, b);
    const double strong = render::delta_e_2000(render::lab_of(a.at(3, 2)), render::lab_of(b.at(3, 2)));
    EXPECT_EQ(d.largest, strong);
    EXPECT_NEAR(d.mean, strong / 800, 1e-3);
    EXPECT_GT(d.mean, strong / 800);
    EXPECT_EQ(d.share, 1.0 / 800);
    EXPECT_EQ(d.picture.at(3, 2), render::color_at(render::colormap_named("magma"), strong / 10));
    EXPECT_EQ(d.picture.at(30, 10), picture_difference(a, a).picture.at(30, 10));
    EXPECT_EQ(picture_difference(a, b, {.threshold = 0}).share, 2.0 / 800);
}

TEST(PictureDifference, IsSymmetric) {
    Image b = gradient();
    for (Rgba& p : b.pixels) p.g = static_cast<std::uint8_t>(255 - p.g);
    const PictureDifference there = picture_difference(gradient(), b), back = picture_difference(b, gradient());
    EXPECT_NEAR(there.mean, back.mean, 1e-9);
    EXPECT_NEAR(there.largest, back.largest, 1e-9);
    EXPECT_EQ(there.share, back.share);
}

TEST(PictureDifference, TransparentPixelsAreWhitePaper) {
    EXPECT_EQ(picture_difference(Image(4, 4, {200, 10, 10, 0}), Image(4, 4)).largest, 0);
    EXPECT_GT(picture_difference(Image(4, 4, {0, 0, 0, 128}), Image(4, 4)).mean, 15);
}

TEST(PictureDifference, RefusesDifferentSizesAndAcceptsEmptyPictures) {
    EXPECT_THROW(picture_difference(Image(4, 5), Image(5, 4)), std::invalid_argument);
    EXPECT_EQ(picture_difference({}, {}).mean, 0);
}

}   // namespace
