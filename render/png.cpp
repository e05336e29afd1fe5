#include "png.h"

#include <libdeflate.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

#include "srgb.h"

namespace {

/// stb's hook: zlib stream of `data`, allocated with malloc; nullptr when out of memory.
unsigned char* deflate_for_stb(unsigned char* data, int size, int* compressed_size, int /*quality*/) {
    constexpr int level = 6;   // 7 finds 1 % more and takes half as long again
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(libdeflate_alloc_compressor(level),
                                                                                                   libdeflate_free_compressor);
    if (!compressor) return nullptr;
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), static_cast<std::size_t>(size));
    auto* compressed = static_cast<unsigned char*>(std::malloc(bound));
    if (compressed == nullptr) return nullptr;
    *compressed_size =
        static_cast<int>(libdeflate_zlib_compress(compressor.get(), data, static_cast<std::size_t>(size), compressed, bound));
    return compressed;
}

}   // namespace

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_ZLIB_COMPRESS deflate_for_stb
#include <stb_image_write.h>

namespace render {

namespace {

constexpr int largest_side = 16384;   // stb counts the bytes of a picture in int

void check_size(const Image& image, const char* caller) {
    if (image.width < 1 || image.height < 1) throw std::invalid_argument(std::string(caller) + ": the picture is empty");
    if (image.width > largest_side || image.height > largest_side)
        throw std::invalid_argument(std::string(caller) + ": the picture is larger than 16384 on a side");
}

bool is_opaque(const Image& image) {
    for (const Rgba& p : image.pixels)
        if (p.a != 255) return false;
    return true;
}

std::vector<std::uint8_t> rgb_bytes(const Image& image) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const Rgba& p : image.pixels) bytes.insert(bytes.end(), {p.r, p.g, p.b});
    return bytes;
}

Image on_white(const Image& image) {
    Image result(image.width, image.height);
    paste(result, image, 0, 0);
    return result;
}

void append(void* text, void* data, int size) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

/// Shaded surfaces and white ground compress best against the row above. Set once, before any thread encodes.
[[maybe_unused]] const int filter_up = stbi_write_force_png_filter = 2;

}   // namespace

std::string encode_png(const Image& image) {
    check_size(image, "encode_png");
    static_assert(sizeof(Rgba) == 4);
    int size = 0;
    const int channels = is_opaque(image) ? 3 : 4;
    const std::vector<std::uint8_t> rgb = channels == 3 ? rgb_bytes(image) : std::vector<std::uint8_t>{};
    const void* pixels = channels == 3 ? static_cast<const void*>(rgb.data()) : image.pixels.data();
    const std::unique_ptr<unsigned char, decltype(&std::free)> png(
        stbi_write_png_to_mem(static_cast<const unsigned char*>(pixels), channels * image.width, image.width, image.height, channels,
                              &size),
        std::free);
    if (!png) throw std::bad_alloc();
    return {reinterpret_cast<const char*>(png.get()), static_cast<std::size_t>(size)};
}

std::string encode_jpeg(const Image& image, int quality) {
    check_size(image, "encode_jpeg");
    if (quality < 1 || quality > 100) throw std::invalid_argument("encode_jpeg: quality must lie in 1 to 100");
    const std::vector<std::uint8_t> rgb = rgb_bytes(is_opaque(image) ? image : on_white(image));
    std::string jpeg;
    if (stbi_write_jpg_to_func(append, &jpeg, image.width, image.height, 3, rgb.data(), quality) == 0) throw std::bad_alloc();
    return jpeg;
}

}   // namespace render
