#include "png/png.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "render/decode_picture.h"

namespace {

using render::Image;
using render::Rgba;

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char c : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
}

/// A picture as stb_image reads it.
Image read(std::string_view file, int* channels) {
    int width = 0, height = 0;
    const std::unique_ptr<stbi_uc, decltype(&std::free)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), static_cast<int>(file.size()), &width, &height, channels, 4),
        std::free);
    if (!pixels) {
        ADD_FAILURE() << "stb_image: " << stbi_failure_reason();
        return {};
    }
    Image image(width, height);
    std::memcpy(image.pixels.data(), pixels.get(), 4 * image.pixels.size());
    return image;
}

struct Decoded {
    Image image;
    int channels = 0;
};

/// The picture, after a look at what stb_image does not check: order, lengths and checksums of the chunks, and a zlib stream of just the
/// right size with the right checksum.
Decoded decoded(std::string_view png) {
    Decoded result;
    result.image = read(png, &result.channels);
    EXPECT_EQ(png.substr(0, 8), std::string_view("\x89PNG\r\n\x1a\n", 8));
    png.remove_prefix(8);
    std::string idat, names;
    while (png.size() >= 12) {
        const std::uint32_t length = big_endian(png);
        const std::string_view name = png.substr(4, 4), data = png.substr(8, length);
        EXPECT_EQ(libdeflate_crc32(0, png.data() + 4, length + 4), big_endian(png.substr(8 + length)));
        names += std::string(name) + " ";
        if (name == "IHDR") {
            EXPECT_EQ(data.size(), 13);
            EXPECT_EQ(data.substr(8), std::string({8, result.channels == 3 ? '\2' : '\6', 0, 0, 0}));
        } else if (name == "IDAT") {
            idat += data;
        }
        png.remove_prefix(12 + length);
    }
    EXPECT_EQ(names, "IHDR IDAT IEND ");
    EXPECT_TRUE(png.empty());
    std::vector<std::uint8_t> raw(static_cast<std::size_t>((1 + result.channels * result.image.width) * result.image.height));
    libdeflate_decompressor* inflate = libdeflate_alloc_decompressor();
    EXPECT_EQ(libdeflate_zlib_decompress(inflate, idat.data(), idat.size(), raw.data(), raw.size(), nullptr), LIBDEFLATE_SUCCESS);
    libdeflate_free_decompressor(inflate);
    return result;
}

void expect_survives(const Image& image, const std::string& what) {
    const Decoded back = decoded(render::encode_png(image));
    ASSERT_EQ(back.image.width, image.width) << what;
    ASSERT_EQ(back.image.height, image.height) << what;
    EXPECT_TRUE(back.image.pixels == image.pixels) << what;
}

Image noise(int width, int height, bool opaque) {
    std::mt19937_64 random(static_cast<std::uint64_t>(width * 1000 + height));
    Image image(width, height);
    for (Rgba& p : image.pixels) {
        const std::uint64_t bits = random();
        p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8), static_cast<std::uint8_t>(bits >> 16),
             opaque ? std::uint8_t{255} : static_cast<std::uint8_t>(bits >> 24)};
    }
    return image;
}

std::uint8_t byte(int v) { return static_cast<std::uint8_t>(v); }

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = {byte(x / 4), byte(y / 4), byte((x + y) / 8), 255};
    return image;
}

/// Rectangles of one colour, of noise and of steps, some of them transparent, one over another.
Image patchwork(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
    const bool opaque = below(2) == 0;
    Image image(1 + below(300), 1 + below(300), {byte(below(256)), 255, 255, 255});
    for (int patch = below(12); patch > 0; --patch) {
        const int x0 = below(image.width), y0 = below(image.height), x1 = x0 + below(image.width - x0), y1 = y0 + below(image.height - y0);
        const int kind = below(3), a = below(256), b = below(256), alpha = opaque ? 255 : below(256);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x)
                image.at(x, y) = kind == 0   ? Rgba{byte(a), byte(b), byte(a), byte(alpha)}
                                 : kind == 1 ? Rgba{byte(below(256)), byte(below(a + 1)), byte(b), byte(alpha)}
                                             : Rgba{byte(a + x), byte(b + y / 3), byte(x * y / 16), byte(opaque ? 255 : x)};
    }
    return image;
}

TEST(Png, EveryPixelSurvives) {
    for (const bool opaque : {true, false})
        for (const auto& [width, height] : {std::pair{1, 1}, {1, 50}, {50, 1}, {2, 2}, {3, 1}, {37, 23}, {256, 100}, {700, 500}}) {
            const std::string size = std::to_string(width) + "x" + std::to_string(height);
            expect_survives(noise(width, height, opaque), "noise " + size);
            expect_survives(Image(width, height, {9, 8, 7, opaque ? std::uint8_t{255} : std::uint8_t{6}}), "flat " + size);
            expect_survives(gradient(width, height), "gradient " + size);
        }
}

TEST(Png, PatchworksSurvive) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) expect_survives(patchwork(seed), "seed " + std::to_string(seed));
}

/// A filter that looks at the wrong neighbour, or breaks a tie wrongly, is found by the reader, which undoes the right one.
TEST(Png, AllNeighboursOfAPixelSurvive) {
    Image image(4 * 16 * 16, 32);   // 2 × 2 pixels of each four of 8 levels, in red; halves of it in green and blue
    for (int i = 0; i < 8 * 8 * 8 * 8; ++i) {
        const int x = i % 512 * 2, y = i / 512 * 2;
        for (int k = 0; k < 4; ++k) image.at(x + k % 2, y + k / 2) = {byte((i >> 3 * k & 7) * 36), byte(i >> k), byte(i >> 2 * k), 255};
    }
    expect_survives(image, "levels");
}

TEST(Png, FlatPicturesAreTinyAndNoiseHardlyGrows) {
    EXPECT_LT(render::encode_png(Image(1024, 1024, {10, 20, 30, 255})).size(), 6000);
    EXPECT_LT(render::encode_png(Image(1024, 1024, {10, 20, 30, 40})).size(), 8000);
    EXPECT_LT(render::encode_png(Image(1, 1)).size(), 80);
    const std::size_t raw = (1 + 4 * 1000) * 1000;   // 62 parts of 64 kB, 16 blocks
    EXPECT_LE(render::encode_png(noise(1000, 1000, false)).size(), raw + 62 * 5 + 16 * 8 + 57 + 6);
}

TEST(Png, OpaquePicturesHaveThreeChannels) {
    Image image(20, 20);
    EXPECT_EQ(decoded(render::encode_png(image)).channels, 3);
    image.at(7, 7).a = 254;
    EXPECT_EQ(decoded(render::encode_png(image)).channels, 4);
}

TEST(Png, TheResolutionIsOneChunkBehindTheHeader) {
    const Image image = gradient(30, 20);
    const std::string plain = render::encode_png(image), png = render::encode_png(image, 300);
    constexpr std::size_t header = 8 + 25, chunk = 12 + 9;
    ASSERT_EQ(png.size(), plain.size() + chunk);
    EXPECT_EQ(png.substr(0, header) + png.substr(header + chunk), plain);
    const std::string_view resolution = std::string_view(png).substr(header, chunk);
    EXPECT_EQ(big_endian(resolution), 9);
    EXPECT_EQ(resolution.substr(4, 4), "pHYs");
    for (const std::size_t at : {8, 12}) EXPECT_EQ(big_endian(resolution.substr(at)), 11811);   // 300 / 0.0254 a metre
    EXPECT_EQ(resolution[16], 1);
    EXPECT_EQ(libdeflate_crc32(0, resolution.data() + 4, 13), big_endian(resolution.substr(17)));
}

TEST(Png, PicturesWithTheLongestSidesSurvive) {
    expect_survives(gradient(16384, 40), "wide");
    expect_survives(noise(3, 16384, false), "high");
}

TEST(Png, EmptyAndTooLargePicturesAreRefused) {
    EXPECT_THROW(render::encode_png(Image{}), std::invalid_argument);
    Image huge;   // only its size is looked at
    huge.width = huge.height = 22000;
    EXPECT_THROW(render::encode_png(huge), std::invalid_argument);
    EXPECT_THROW(render::encode_jpeg(Image{}, 80), std::invalid_argument);
    EXPECT_THROW(render::encode_jpeg(Image(3, 3), 0), std::invalid_argument);
}

TEST(Jpeg, ReadsBackNearlyTheSameOnWhite) {
    Image image(64, 48, {0, 0, 0, 0});   // transparent: comes out white
    for (int y = 0; y < 48; ++y)
        for (int x = 20; x < 64; ++x)
            image.at(x, y) = {static_cast<std::uint8_t>(2 * x + 40), static_cast<std::uint8_t>(3 * y + 60), 120, 255};
    const std::string jpeg = render::encode_jpeg(image, 95);
    int channels = 0;
    const Image back = read(jpeg, &channels);
    ASSERT_EQ(back.width, 64);
    ASSERT_EQ(back.height, 48);
    EXPECT_NEAR(back.at(5, 5).r, 255, 3);
    for (const auto& [x, y] : {std::pair{40, 20}, {60, 44}, {30, 8}}) {
        EXPECT_NEAR(back.at(x, y).r, image.at(x, y).r, 6);
        EXPECT_NEAR(back.at(x, y).g, image.at(x, y).g, 6);
        EXPECT_NEAR(back.at(x, y).b, image.at(x, y).b, 6);
    }
}

}   // namespace

TEST(DecodePng, RestoresEveryPixel) {
    Image image(37, 23);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const auto v = static_cast<std::uint8_t>(i * 7);
        image.pixels[i] = {v, static_cast<std::uint8_t>(v * 3), static_cast<std::uint8_t>(i / 5), 255};
    }
    for (const std::uint8_t alpha : {std::uint8_t{255}, std::uint8_t{128}}) {
        image.pixels[5].a = alpha;
        const auto back = render::decode_png(render::encode_png(image));
        ASSERT_TRUE(back);
        EXPECT_EQ(back->width, image.width);
        EXPECT_EQ(back->height, image.height);
        EXPECT_EQ(back->pixels, image.pixels);
    }
}

TEST(DecodePng, RefusesOtherBytesCutOffAndTooLargePictures) {
    const std::string png = render::encode_png(Image(40, 30));
    EXPECT_FALSE(render::decode_png(""));
    EXPECT_FALSE(render::decode_png("\xff\xd8\xff no PNG"));
    EXPECT_FALSE(render::decode_png(png, 40 * 30 - 1));
    EXPECT_TRUE(render::decode_png(png, 40 * 30));
    for (std::size_t size = 0; size < 45; ++size) EXPECT_FALSE(render::decode_png(png.substr(0, size))) << size;
    std::string greedy = png;
    greedy[33] = 0x40;   // the chunk behind the header has a gigabyte, it says
    EXPECT_FALSE(render::decode_png(greedy));
    EXPECT_TRUE(render::decode_png(png + "what follows is no matter"));
}
