#include <climits>
#include <cstring>
#include <memory>

#include "png/png.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#ifdef __clang_analyzer__   // the library's own functions are not judged
#undef STB_IMAGE_STATIC
#undef STB_IMAGE_IMPLEMENTATION
#endif
#include <stb_image.h>

namespace render {

namespace {

/// Every chunk has the bytes that it says: stb_image takes memory for them before it looks.
bool has_whole_chunks(std::string_view png) {
    constexpr std::size_t signature = 8, around = 12;   // length, name and checksum
    if (png.size() < signature) return false;
    png.remove_prefix(signature);
    while (!png.empty()) {
        if (png.size() < around) return false;
        std::size_t length = 0;
        for (const char byte : png.substr(0, 4)) length = length << 8 | static_cast<unsigned char>(byte);
        if (length > png.size() - around) return false;
        if (png.substr(4, 4) == "IEND") return true;   // what follows is not read
        png.remove_prefix(around + length);
    }
    return false;
}

}   // namespace

std::optional<Image> decode_png(std::string_view png, std::int64_t largest) {
    if (png.size() > INT_MAX || !has_whole_chunks(png)) return {};
    const auto* bytes = reinterpret_cast<const stbi_uc*>(png.data());
    const int size = static_cast<int>(png.size());
    int width = 0, height = 0, channels = 0;
    // The size first: the header alone may ask for any amount of memory.
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
