#include "srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace render {

namespace {

double decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

struct Tables {
    static constexpr int steps = 16384;   // fine enough that neighbouring dark channels stay apart
    std::array<float, 256> linear;
    std::array<std::uint8_t, steps + 1> channel;

    Tables() {
        for (int i = 0; i < 256; ++i) linear[static_cast<std::size_t>(i)] = static_cast<float>(decoded(i / 255.0));
        int c = 0;
        for (int i = 0; i <= steps; ++i) {
            while (c < 255 && double(i) / steps >= decoded((c + 0.5) / 255)) ++c;
            channel[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(c);
        }
    }
};

const Tables& tables() {
    static const Tables t;
    return t;
}

std::uint8_t byte_of(float alpha) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(alpha, 0.0F, 1.0F))); }

}   // namespace

float linear_of(std::uint8_t channel) { return tables().linear[channel]; }

std::uint8_t srgb_of(float linear) {
    return tables().channel[static_cast<std::size_t>(std::clamp(linear, 0.0F, 1.0F) * Tables::steps + 0.5F)];
}

LinearColor linear_of(Rgba color) {
    const std::array<float, 256>& linear = tables().linear;
    const float a = static_cast<float>(color.a) / 255;
    return {a * linear[color.r], a * linear[color.g], a * linear[color.b], a};
}

Rgba srgb_of(const LinearColor& color) {
    if (color.a <= 0) return {0, 0, 0, 0};
    const float scale = 1 / color.a;
    return {srgb_of(scale * color.r), srgb_of(scale * color.g), srgb_of(scale * color.b), byte_of(color.a)};
}

}   // namespace render
