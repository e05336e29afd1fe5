#include "png/png.h"

#include <libdeflate.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>
#include <vector>

#include "png/deflate_runs.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace render {

namespace {

using Byte = std::uint8_t;

constexpr std::int64_t largest_jpeg = std::int64_t{16384} * 16384;

void check_size(const Image& image, std::int64_t largest, const char* caller) {
    if (image.width < 1 || image.height < 1) throw std::invalid_argument(std::string(caller) + ": the picture is empty");
    if (std::int64_t{image.width} * image.height > largest)
        throw std::invalid_argument(std::string(caller) + ": the picture has more than " + std::to_string(largest) + " pixels");
}

bool is_opaque(const Image& image) {
    constexpr std::size_t stretch = 1 << 16;
    std::atomic<bool> opaque = true;
    tbb::parallel_for(std::size_t{0}, (image.pixels.size() - 1) / stretch + 1, [&](std::size_t i) {
        const std::size_t begin = i * stretch, end = std::min(begin + stretch, image.pixels.size());
        Byte common = 255;
        for (std::size_t k = begin; k < end; ++k) common &= image.pixels[k].a;
        if (common != 255) opaque = false;
    });
    return opaque;
}

/// Three bytes a pixel. Writes one byte beyond.
void copy_rgb(const Rgba* pixels, std::size_t count, Byte* rgb) {
    for (std::size_t i = 0; i < count; ++i) std::memcpy(rgb + 3 * i, pixels + i, 4);
}

std::vector<Byte> rgb_bytes(const Image& image) {
    std::vector<Byte> bytes(3 * image.pixels.size() + 1);
    copy_rgb(image.pixels.data(), image.pixels.size(), bytes.data());
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

std::string big_endian(std::size_t v) {
    return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

/// A chunk: length, name, contents, checksum of name and contents. Returns where the name begins.
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

/// A row less its Paeth prediction (PNG 1.2, 6.6): of the bytes a to the left, b above and c above to the left the one nearest to
/// a + b − c. Its distances to a, b, c are |b − c|, |a − c| and, where c lies between a and b, the difference of these two; elsewhere
/// their sum, which is never the least. All in bytes, so that sixteen are done at a time.
void subtract_paeth(const Byte* row, const Byte* above, std::size_t size, std::size_t channels, Byte* __restrict rest) {
    const Byte *const left = row - channels, *const upper_left = above - channels;
    for (std::size_t i = 0; i < size; ++i) {
        const Byte a = left[i], b = above[i], c = upper_left[i];
        const Byte to_a = distance(b, c), to_b = distance(a, c), least = lesser(to_a, to_b);
        const Byte nearer = to_a == least ? a : b;
        const Byte inside = greater(lesser(a, b), lesser(c, greater(a, b)));   // c if it lies between
        rest[i] = static_cast<Byte>(row[i] - (inside == c && distance(to_a, to_b) < least ? c : nearer));
    }
}

/// Row y less its prediction, after the number of the filter. Stretches that repeat the row above, as the ground does, leave only zeros.
/// False where another shows something through.
bool filter_row(const Image& image, std::size_t channels, int y, Byte* line) {
    constexpr int stretch = 64;
    const auto copy = [&](int x, int row, int count, Byte* bytes) {
        channels == 4 ? void(std::memcpy(bytes, &image.at(x, row), 4 * static_cast<std::size_t>(count)))
                      : copy_rgb(&image.at(x, row), static_cast<std::size_t>(count), bytes);
    };
    Byte opacity = 255;
    *line++ = 4;
    for (int x = 0; x < image.width; x += stretch) {
        const int left = x > 0 ? 1 : 0, count = std::min(stretch, image.width - x);   // a pixel to the left, empty at the margin
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

Band band_of(const Image& image, std::size_t channels, int begin, int end) {
    const std::size_t line = 1 + channels * static_cast<std::size_t>(image.width), size = line * static_cast<std::size_t>(end - begin);
    std::vector<Byte> lines(size);
    bool opaque = true;
    for (int y = begin; y < end; ++y) opaque &= filter_row(image, channels, y, &lines[line * static_cast<std::size_t>(y - begin)]);
    return {{lines.data(), size, channels, end == image.height}, libdeflate_adler32(1, lines.data(), size), size, opaque};
}

/// The checksum (RFC 1950, 8.2) of what has the checksum `first`, followed by `size` bytes that have `second`.
std::uint32_t joined_checksum(std::uint32_t first, std::uint32_t second, std::size_t size) {
    constexpr std::uint64_t base = 65521;
    const std::uint64_t before = (first & 65535) + base - 1;   // the sum of bytes, with which each that follows adds to the sum of sums
    const std::uint64_t sum = before + (second & 65535), sums = (first >> 16) + (second >> 16) + size % base * before;
    return static_cast<std::uint32_t>(sums % base << 16 | sum % base);
}

/// Made on all processors; the bytes do not depend on how many there are.
std::vector<std::optional<Band>> bands_of(const Image& image, std::size_t channels) {
    const std::size_t line = 1 + channels * static_cast<std::size_t>(image.width);
    const int rows = static_cast<int>(1 + (std::size_t{1} << 18) / line), count = (image.height - 1) / rows + 1;
    std::vector<std::optional<Band>> bands(static_cast<std::size_t>(count));
    tbb::parallel_for(0, count, [&](int i) {
        bands[static_cast<std::size_t>(i)] = band_of(image, channels, i * rows, std::min(image.height, (i + 1) * rows));
    });
    return bands;
}

/// The zlib stream (RFC 1950) of the filtered rows.
void append_compressed(std::string& png, const std::vector<std::optional<Band>>& bands) {
    std::size_t most = png.size() + 64;   // and what stands around the blocks
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

}   // namespace

std::string encode_png(const Image& image) {
    check_size(image, largest_png, "encode_png");
    // Without alpha if all is opaque, which is found on the way.
    std::size_t channels = image.pixels.front().a == 255 ? 3 : 4;
    std::vector<std::optional<Band>> bands = bands_of(image, channels);
    if (channels == 3 && !std::ranges::all_of(bands, [](const std::optional<Band>& band) { return band->opaque; }))
        bands = bands_of(image, channels = 4);
    std::string png = "\x89PNG\r\n\x1a\n";
    std::size_t begin = open_chunk(png, "IHDR");
    png += big_endian(static_cast<std::size_t>(image.width)) + big_endian(static_cast<std::size_t>(image.height));
    png += {8, channels == 3 ? '\2' : '\6', 0, 0, 0};   // 8 bits, RGB or RGBA, the only compression and filters there are, not interlaced
    close_chunk(png, begin);
    begin = open_chunk(png, "IDAT");
    append_compressed(png, bands);
    close_chunk(png, begin);
    close_chunk(png, open_chunk(png, "IEND"));
    return png;
}

std::string encode_jpeg(const Image& image, int quality) {
    check_size(image, largest_jpeg, "encode_jpeg");
    if (quality < 1 || quality > 100) throw std::invalid_argument("encode_jpeg: quality must lie in 1 to 100");
    const std::vector<Byte> rgb = rgb_bytes(is_opaque(image) ? image : on_white(image));
    std::string jpeg;
    if (stbi_write_jpg_to_func(append, &jpeg, image.width, image.height, 3, rgb.data(), quality) == 0) throw std::bad_alloc();
    return jpeg;
}

}   // namespace render
