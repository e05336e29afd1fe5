#include "png.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string_view>
#include <vector>

#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

namespace {

using render::Image;
using render::Rgba;

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char c : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
}

struct Decoded {
    Image image;
    int channels = 0;
    bool all_rows_up = true;
};

/// Reads what the encoder may write: signature, IHDR, IDAT, IEND with right checksums; 8-bit RGB or RGBA; filters None and Up.
Decoded decoded(std::string_view png) {
    EXPECT_EQ(png.substr(0, 8), std::string_view("\x89PNG\r\n\x1a\n", 8));
    png.remove_prefix(8);
    Decoded result;
    std::string idat, names;
    int width = 0, height = 0;
    while (png.size() >= 12) {
        const std::uint32_t length = big_endian(png);
        const std::string_view name = png.substr(4, 4), data = png.substr(8, length);
        EXPECT_EQ(libdeflate_crc32(0, png.data() + 4, length + 4), big_endian(png.substr(8 + length)));
        names += std::string(name) + " ";
        if (name == "IHDR") {
            width = static_cast<int>(big_endian(data)), height = static_cast<int>(big_endian(data.substr(4)));
            EXPECT_EQ(data[8], 8);
            result.channels = data[9] == 2 ? 3 : data[9] == 6 ? 4 : 0;
        } else if (name == "IDAT") {
            idat += data;
        }
        png.remove_prefix(12 + length);
    }
    EXPECT_EQ(names, "IHDR IDAT IEND ");
    EXPECT_TRUE(png.empty());
    const std::size_t channels = static_cast<std::size_t>(result.channels), line = 1 + channels * static_cast<std::size_t>(width);
    std::vector<std::uint8_t> raw(line * static_cast<std::size_t>(height));
    libdeflate_decompressor* inflate = libdeflate_alloc_decompressor();
    EXPECT_EQ(libdeflate_zlib_decompress(inflate, idat.data(), idat.size(), raw.data(), raw.size(), nullptr), LIBDEFLATE_SUCCESS);
    libdeflate_free_decompressor(inflate);
    result.image = Image(width, height);
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        const std::uint8_t filter = raw[y * line];
        // stb writes the first row, which has none above it, unfiltered bytes under the number of the filter
        result.all_rows_up = result.all_rows_up && (filter == 2 || (y == 0 && filter == 0));
        for (std::size_t i = 1; filter == 2 && y > 0 && i < line; ++i)
            raw[y * line + i] = static_cast<std::uint8_t>(raw[y * line + i] + raw[(y - 1) * line + i]);
        for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
            const std::uint8_t* p = &raw[y * line + 1 + channels * x];
            result.image.at(static_cast<int>(x), static_cast<int>(y)) = {p[0], p[1], p[2], channels == 4 ? p[3] : std::uint8_t{255}};
        }
    }
    return result;
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

TEST(Png, EveryPixelSurvives) {
    for (const bool opaque : {true, false})
        for (const auto& [width, height] : {std::pair{1, 1}, {1, 50}, {50, 1}, {37, 23}, {256, 100}}) {
            const Image image = noise(width, height, opaque);
            const Decoded back = decoded(render::encode_png(image));
            ASSERT_EQ(back.image.width, width);
            ASSERT_EQ(back.image.height, height);
            EXPECT_EQ(back.image.pixels, image.pixels);
            EXPECT_TRUE(back.all_rows_up);
        }
}

TEST(Png, OpaquePicturesHaveThreeChannels) {
    Image image(20, 20);
    EXPECT_EQ(decoded(render::encode_png(image)).channels, 3);
    image.at(7, 7).a = 254;
    EXPECT_EQ(decoded(render::encode_png(image)).channels, 4);
}

TEST(Png, WidestPictureIsWritten) { EXPECT_EQ(decoded(render::encode_png(Image(16384, 2, {1, 2, 3, 255}))).image.width, 16384); }

TEST(Png, EmptyAndTooLargePicturesAreRefused) {
    EXPECT_THROW(render::encode_png(Image{}), std::invalid_argument);
    EXPECT_THROW(render::encode_png(Image(16385, 1)), std::invalid_argument);
    EXPECT_THROW(render::encode_png(Image(1, 16385)), std::invalid_argument);
    EXPECT_THROW(render::encode_jpeg(Image{}, 80), std::invalid_argument);
    EXPECT_THROW(render::encode_jpeg(Image(3, 3), 0), std::invalid_argument);
}

TEST(Jpeg, ReadsBackNearlyTheSameOnWhite) {
    Image image(64, 48, {0, 0, 0, 0});   // transparent: comes out white
    for (int y = 0; y < 48; ++y)
        for (int x = 20; x < 64; ++x)
            image.at(x, y) = {static_cast<std::uint8_t>(2 * x + 40), static_cast<std::uint8_t>(3 * y + 60), 120, 255};
    const std::string jpeg = render::encode_jpeg(image, 95);
    int width = 0, height = 0, channels = 0;
    stbi_uc* pixels =
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(jpeg.data()), static_cast<int>(jpeg.size()), &width, &height, &channels, 3);
    ASSERT_NE(pixels, nullptr);
    ASSERT_EQ(width, 64);
    ASSERT_EQ(height, 48);
    const auto at = [&](int x, int y) { return pixels + 3 * (y * width + x); };
    EXPECT_NEAR(at(5, 5)[0], 255, 3);
    for (const auto& [x, y] : {std::pair{40, 20}, {60, 44}, {30, 8}}) {
        EXPECT_NEAR(at(x, y)[0], image.at(x, y).r, 6);
        EXPECT_NEAR(at(x, y)[1], image.at(x, y).g, 6);
        EXPECT_NEAR(at(x, y)[2], image.at(x, y).b, 6);
    }
    std::free(pixels);
}

}   // namespace
