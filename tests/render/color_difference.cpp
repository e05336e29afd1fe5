#include "render/color_difference.h"

#include <cmath>
#include <numbers>

namespace render {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

double cos_of(double angle) { return std::cos(angle / degrees); }

/// The angle of (a, b) in [0, 360).
double hue_of(double a, double b) {
    const double hue = std::atan2(b, a) * degrees;
    return hue < 0 ? hue + 360 : hue;
}

/// x⁷ / (x⁷ + 25⁷): the blend towards strong colours.
double share_of_strong(double chroma) {
    const double seventh = std::pow(chroma, 7);
    return seventh / (seventh + 6103515625.0);
}

}   // namespace

double delta_e_2000(const glm::dvec3& one, const glm::dvec3& two) {
    const double mean_chroma = (std::hypot(one.y, one.z) + std::hypot(two.y, two.z)) / 2;
    const double stretch = 1.5 - 0.5 * std::sqrt(share_of_strong(mean_chroma));   // 1 + G
    const double a1 = stretch * one.y, a2 = stretch * two.y;
    const double C1 = std::hypot(a1, one.z), C2 = std::hypot(a2, two.z), h1 = hue_of(a1, one.z), h2 = hue_of(a2, two.z);
    const bool is_grey = C1 * C2 == 0, around = std::abs(h1 - h2) > 180;

    const double dh = is_grey ? 0 : h2 - h1 + (!around ? 0 : h2 > h1 ? -360 : 360);
    const double dL = two.x - one.x, dC = C2 - C1, dH = 2 * std::sqrt(C1 * C2) * std::sin(dh / 2 / degrees);

    const double L = (one.x + two.x) / 2, C = (C1 + C2) / 2;
    const double h = is_grey ? h1 + h2 : (h1 + h2 + (!around ? 0 : h1 + h2 < 360 ? 360 : -360)) / 2;
    const double T = 1 - 0.17 * cos_of(h - 30) + 0.24 * cos_of(2 * h) + 0.32 * cos_of(3 * h + 6) - 0.20 * cos_of(4 * h - 63);
    const double from_50 = (L - 50) * (L - 50);
    const double SL = 1 + 0.015 * from_50 / std::sqrt(20 + from_50), SC = 1 + 0.045 * C, SH = 1 + 0.015 * C * T;
    const double turn = 60 * std::exp(-(h - 275) * (h - 275) / 625);   // 2 Δθ
    const double RT = -2 * std::sqrt(share_of_strong(C)) * std::sin(turn / degrees);

    const double l = dL / SL, c = dC / SC, H = dH / SH;
    return std::sqrt(l * l + c * c + H * H + RT * c * H);
}

}   // namespace render
