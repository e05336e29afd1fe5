// Pictures: any bytes are no PNG, or a picture that is the same after being written and read again.
#include "fuzz/fuzz_input.h"
#include "png/png.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using meshfolio::fuzzing::require;
    constexpr std::int64_t largest = 1 << 14;
    const auto image = render::decode_png(meshfolio::fuzzing::text_of(bytes, size), largest);
    if (!image) return 0;
    require(image->width > 0 && image->height > 0 && std::int64_t{image->width} * image->height <= largest, "a picture has its size");
    const auto again = render::decode_png(render::encode_png(*image), largest);
    require(again && again->width == image->width && again->height == image->height && again->pixels == image->pixels,
            "a picture survives writing and reading");
    return 0;
}
