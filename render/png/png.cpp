#include "png/png.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>
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
    constexpr std::size_t stretch = 4096;
    for (std::size_t begin = 0; begin < image.pixels.size(); begin += stretch) {
        const std::size_t end = std::min(begin + stretch, image.pixels.size());
        Byte common = 255;
        for (std::size_t i = begin; i < end; ++i) common &= image.pixels[i].a;
        if (common != 255) return false;
    }
    return true;
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

/// Rows of the picture on their way through the filter: this one and the one above, each with an empty pixel to its left.
class RowFilter {
public:
    RowFilter(const Image& image, std::size_t channels)
        : image_(image), channels_(channels), size_(channels * static_cast<std::size_t>(image.width)), row_(size_ + 8), above_(size_ + 8) {}

    std::size_t line_size() const { return 1 + size_; }

    /// The next row, after the number of the filter.
    void next(Byte* line) {
        const Rgba* pixels = &image_.at(0, y_++);
        Byte* row = row_.data() + 4;
        if (channels_ == 4)
            std::memcpy(row, pixels, size_);
        else
            copy_rgb(pixels, static_cast<std::size_t>(image_.width), row);
        line[0] = 4;
        subtract_paeth(row, above_.data() + 4, size_, channels_, line + 1);
        std::swap(row_, above_);
    }

private:
    const Image& image_;
    std::size_t channels_, size_;
    int y_ = 0;
    std::vector<Byte> row_, above_;
};

/// The zlib stream (RFC 1950) of the filtered rows, some 256 kB a block.
void append_compressed(std::string& png, const Image& image, std::size_t channels) {
    RowFilter filter(image, channels);
    const std::size_t line = filter.line_size(), lines = static_cast<std::size_t>(image.height);
    const std::size_t lines_in_block = std::min(lines, 1 + (std::size_t{1} << 18) / line);
    std::vector<Byte> block(lines_in_block * line);
    png += "\x78\x01";
    RunDeflater deflater(png, channels);
    std::uint32_t checksum = 1;
    for (std::size_t y = 0; y < lines; y += lines_in_block) {
        const std::size_t count = std::min(lines_in_block, lines - y);
        for (std::size_t i = 0; i < count; ++i) filter.next(&block[i * line]);
        checksum = libdeflate_adler32(checksum, block.data(), count * line);
        deflater.add_block(block.data(), count * line, y + count == lines);
    }
    png += big_endian(checksum);
}

}   // namespace

std::string encode_png(const Image& image) {
    check_size(image, largest_png, "encode_png");
    const std::size_t channels = is_opaque(image) ? 3 : 4;
    std::string png = "\x89PNG\r\n\x1a\n";
    std::size_t begin = open_chunk(png, "IHDR");
    png += big_endian(static_cast<std::size_t>(image.width)) + big_endian(static_cast<std::size_t>(image.height));
    png += {8, channels == 3 ? '\2' : '\6', 0, 0, 0};   // 8 bits, RGB or RGBA, the only compression and filters there are, not interlaced
    close_chunk(png, begin);
    begin = open_chunk(png, "IDAT");
    append_compressed(png, image, channels);
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
