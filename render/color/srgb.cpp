#include "color/srgb.h"

#include <cmath>

namespace render {

namespace {

double decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

}   // namespace

SrgbTables::SrgbTables() {
    for (int i = 0; i < 256; ++i) linear[static_cast<std::size_t>(i)] = static_cast<float>(decoded(i / 255.0));
    int c = 0;
    for (int i = 0; i <= steps; ++i) {
        while (c < 255 && (i + 0.5) / steps >= decoded((c + 0.5) / 255)) ++c;
        channel[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(c);
    }
}

Rgba srgb_of(const LinearColor& color) {
    if (color.a <= 0) return {0, 0, 0, 0};
    const float scale = color.a == 1 ? 1 : 1 / color.a;
    const auto alpha = static_cast<std::uint8_t>(std::lround(255 * std::min(color.a, 1.0F)));
    return {srgb_of(scale * color.r), srgb_of(scale * color.g), srgb_of(scale * color.b), alpha};
}

}   // namespace render
