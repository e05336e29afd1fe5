#include "png/png.h"

#include <libdeflate.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <vector>

#include "png/deflate_runs.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#ifdef __clang_analyzer__   // does not judge the library
#undef STB_IMAGE_STATIC
#undef STB_IMAGE_IMPLEMENTATION
#endif
#include <stb_image.h>

namespace render {

namespace {

using Byte = std::uint8_t;

constexpr std::int64_t largest_jpeg = std::int64_t{16384} * 16384;

void check_size(const Image& image, std::int64_t largest, const char* caller) {
    if (image.width < 1 || image.height < 1)
        throw std::invalid_argument(std::string(caller) + ": the picture is empty (" + std::to_string(image.width) + "x" +
                                    std::to_string(image.height) + ")");
    if (std::int64_t{image.width} * image.height > largest)
        throw std::invalid_argument(std::string(caller) + ": " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                                    " pixels are more than the limit of " + std::to_string(largest) + "; draw a smaller picture");
}

/// Writes three bytes a pixel, and one byte beyond the last.
void copy_rgb(const Rgba* pixels, std::size_t count, Byte* rgb) {
    for (std::size_t i = 0; i < count; ++i) std::memcpy(rgb + 3 * i, pixels + i, 4);
}

void append(void* text, void* data, int size) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::string big_endian(std::size_t v) {
    return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

/// Begins a chunk: length, name, contents, checksum of name and contents. Returns the place of its name, for close_chunk().
std::size_t open_chunk(std::string& png, const char* name) {
    png += big_endian(0) + name;
    return png.size() - 4;
}

void close_chunk(std::string& png, std::size_t begin) {
    png.replace(begin - 4, 4, big_endian(png.size() - begin - 4));
    png += big_endian(libdeflate_crc32(0, png.data() + begin, png.size() - begin));
}

Byte lesser(Byte u, Byte v) { return u < v ? u : v; }
Byte greater(Byte u, Byte v) { return u < v ? v : u; }
Byte distance(Byte u, Byte v) { return static_cast<Byte>(greater(u, v) - lesser(u, v)); }

/// Subtracts the Paeth prediction (PNG 1.2, 6.6) from a row: the one of the bytes a to the left, b above and c above to the left that is
/// nearest to a + b − c. Its distances to a, b, c are |b − c|, |a − c| and, if c lies between a and b, the difference of these two; else
/// their sum, which is never the least. All in bytes, so that one instruction handles sixteen.
void subtract_paeth(const Byte* row, const Byte* above, std::size_t size, std::size_t channels, Byte* __restrict rest) {
    const Byte *const left = row - channels, *const upper_left = above - channels;
    for (std::size_t i = 0; i < size; ++i) {
        const Byte a = left[i], b = above[i], c = upper_left[i];
        const Byte to_a = distance(b, c), to_b = distance(a, c), least = lesser(to_a, to_b);
        const Byte nearer = to_a == least ? a : b;
        const Byte inside = greater(lesser(a, b), lesser(c, greater(a, b)));   // c if it lies between a and b
        rest[i] = static_cast<Byte>(row[i] - (inside == c && distance(to_a, to_b) < least ? c : nearer));
    }
}

/// Writes filter number 4 and row y minus its Paeth prediction, 1 + channels · width bytes. Stretches that repeat the row above, such as
/// background, give zeros. Returns false if a pixel outside of such stretches is not opaque.
bool filter_row(const Image& image, std::size_t channels, int y, Byte* line) {
    constexpr int stretch = 64;
    const auto copy = [&](int x, int row, int count, Byte* bytes) {
        channels == 4 ? void(std::memcpy(bytes, &image.at(x, row), 4 * static_cast<std::size_t>(count)))
                      : copy_rgb(&image.at(x, row), static_cast<std::size_t>(count), bytes);
    };
    Byte opacity = 255;
    *line++ = 4;
    for (int x = 0; x < image.width; x += stretch) {
        const int left = x > 0 ? 1 : 0, count = std::min(stretch, image.width - x);   // pixels to the left; none at the margin
        const std::size_t bytes = channels * static_cast<std::size_t>(count), begin = channels * static_cast<std::size_t>(1 - left);
        if (y > 0 && std::memcmp(&image.at(x - left, y), &image.at(x - left, y - 1), 4 * static_cast<std::size_t>(left + count)) == 0) {
            std::memset(line, 0, bytes);
        } else {
            std::array<Byte, 4 * (stretch + 2)> row{}, above{};
            copy(x - left, y, left + count, &row[begin]);
            for (int k = 0; k < count; ++k) opacity &= image.at(x + k, y).a;
            if (y > 0) copy(x - left, y - 1, left + count, &above[begin]);
            subtract_paeth(&row[channels], &above[channels], bytes, channels, line);
        }
        line += bytes;
    }
    return opacity == 255;
}

/// Some 256 kB of filtered rows.
struct Band {
    DeflatedBlock block;
    std::uint32_t checksum;
    std::size_t size;
    bool opaque;
};

/// Filters and deflates the bands of a picture on all processors, with the same bytes for any number of them.
std::vector<std::optional<Band>> bands_of(const Image& image, std::size_t channels) {
    const std::size_t line = 1 + channels * static_cast<std::size_t>(image.width);
    const int rows = static_cast<int>(1 + (std::size_t{1} << 18) / line), count = (image.height - 1) / rows + 1;
    std::vector<std::optional<Band>> bands(static_cast<std::size_t>(count));
    tbb::parallel_for(0, count, [&](int i) {
        const int begin = i * rows, end = std::min(image.height, begin + rows);
        std::vector<Byte> lines(line * static_cast<std::size_t>(end - begin));
        bool opaque = true;
        for (int y = begin; y < end; ++y) opaque &= filter_row(image, channels, y, &lines[line * static_cast<std::size_t>(y - begin)]);
        bands[static_cast<std::size_t>(i)] = {{lines.data(), lines.size(), channels, end == image.height},
                                              libdeflate_adler32(1, lines.data(), lines.size()),
                                              lines.size(),
                                              opaque};
    });
    return bands;
}

/// Returns the checksum (RFC 1950, 8.2) of bytes with the checksum `first`, followed by `size` bytes with the checksum `second`.
std::uint32_t joined_checksum(std::uint32_t first, std::uint32_t second, std::size_t size) {
    constexpr std::uint64_t base = 65521;
    const std::uint64_t before = (first & 65535) + base - 1;   // the first sum of bytes, which each later byte adds to the sum of sums
    const std::uint64_t sum = before + (second & 65535), sums = (first >> 16) + (second >> 16) + size % base * before;
    return static_cast<std::uint32_t>(sums % base << 16 | sum % base);
}

/// Appends the zlib stream (RFC 1950) of the filtered rows.
void append_compressed(std::string& png, const std::vector<std::optional<Band>>& bands) {
    std::size_t most = png.size() + 64;   // for the bytes around the blocks
    for (const std::optional<Band>& band : bands) most += band->block.largest_size();
    png.reserve(most);
    png += "\x78\x01";
    DeflateStream stream(png);
    std::uint32_t checksum = 1;
    for (const std::optional<Band>& band : bands) {
        stream.add(band->block);
        checksum = joined_checksum(checksum, band->checksum, band->size);
    }
    png += big_endian(checksum);
}

/// True if every chunk is as long as it says: stb_image allocates memory for the chunk before it looks.
bool has_whole_chunks(std::string_view png) {
    constexpr std::size_t signature = 8, around = 12;   // length, name and checksum
    if (png.size() < signature) return false;
    png.remove_prefix(signature);
    while (!png.empty()) {
        if (png.size() < around) return false;
        std::size_t length = 0;
        for (const char byte : png.substr(0, 4)) length = length << 8 | static_cast<unsigned char>(byte);
        if (length > png.size() - around) return false;
        if (png.substr(4, 4) == "IEND") return true;   // the rest is not read
        png.remove_prefix(around + length);
    }
    return false;
}

}   // namespace

std::string encode_png(const Image& image, double pixels_per_inch) {
    check_size(image, largest_png, "encode_png");
    std::size_t channels = image.pixels.front().a == 255 ? 3 : 4;   // no alpha if all pixels are opaque, which filtering finds out
    std::vector<std::optional<Band>> bands = bands_of(image, channels);
    if (channels == 3 && !std::ranges::all_of(bands, [](const std::optional<Band>& band) { return band->opaque; }))
        bands = bands_of(image, channels = 4);
    std::string png = "\x89PNG\r\n\x1a\n";
    std::size_t begin = open_chunk(png, "IHDR");
    png += big_endian(static_cast<std::size_t>(image.width)) + big_endian(static_cast<std::size_t>(image.height));
    png += {8, channels == 3 ? '\2' : '\6', 0, 0, 0};   // 8 bits, RGB or RGBA, standard compression and filters, not interlaced
    close_chunk(png, begin);
    if (pixels_per_inch > 0) {
        const std::string per_metre = big_endian(static_cast<std::size_t>(std::lround(pixels_per_inch / 0.0254)));
        begin = open_chunk(png, "pHYs");
        png += per_metre + per_metre + '\1';   // in metres
        close_chunk(png, begin);
    }
    begin = open_chunk(png, "IDAT");
    append_compressed(png, bands);
    close_chunk(png, begin);
    close_chunk(png, open_chunk(png, "IEND"));
    return png;
}

std::string encode_jpeg(const Image& image, int quality) {
    check_size(image, largest_jpeg, "encode_jpeg");
    if (quality < 1 || quality > 100)
        throw std::invalid_argument("encode_jpeg: quality must lie in 1 to 100, not " + std::to_string(quality));
    Image on_white(image.width, image.height);
    paste(on_white, image, 0, 0);
    std::vector<Byte> rgb(3 * on_white.pixels.size() + 1);
    copy_rgb(on_white.pixels.data(), on_white.pixels.size(), rgb.data());
    std::string jpeg;
    if (stbi_write_jpg_to_func(append, &jpeg, image.width, image.height, 3, rgb.data(), quality) == 0) throw std::bad_alloc();
    return jpeg;
}

std::optional<Image> decode_png(std::string_view png, std::int64_t largest) {
    if (png.size() > INT_MAX || !has_whole_chunks(png)) return {};
    const auto* bytes = reinterpret_cast<const stbi_uc*>(png.data());
    const int size = static_cast<int>(png.size());
    int width = 0, height = 0, channels = 0;
    // Checks the size first: the header alone may ask for any amount of memory.
    if (stbi_info_from_memory(bytes, size, &width, &height, &channels) == 0) return {};
    if (width < 1 || height < 1 || std::int64_t{width} * height > largest) return {};
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(stbi_load_from_memory(bytes, size, &width, &height, &channels, 4),
                                                                      &stbi_image_free);
    if (pixels == nullptr) return {};
    Image image(width, height);
    std::memcpy(image.pixels.data(), pixels.get(), 4 * image.pixels.size());
    return image;
}

}   // namespace render
