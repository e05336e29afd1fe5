#include "color/srgb.h"

#include <cmath>
#include <glm/mat3x3.hpp>

namespace render {

namespace {

double decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

constexpr glm::dvec3 white{0.95047, 1, 1.08883};

/// The matrix from linear sRGB to XYZ (IEC 61966-2-1), by columns.
const glm::dmat3 xyz_of_rgb{0.4124564, 0.2126729, 0.0193339, 0.3575761, 0.7151522, 0.1191920, 0.1804375, 0.0721750, 0.9503041};

constexpr double epsilon = 216.0 / 24389, kappa = 24389.0 / 27;

double lab_root(double t) { return t > epsilon ? std::cbrt(t) : (kappa * t + 16) / 116; }
double lab_cube(double u) { return u * u * u > epsilon ? u * u * u : (116 * u - 16) / kappa; }

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

glm::dvec3 lab_of(Rgba color) {
    const glm::dvec3 xyz = xyz_of_rgb * glm::dvec3(linear_of(color.r), linear_of(color.g), linear_of(color.b)) / white;
    const double fx = lab_root(xyz.x), fy = lab_root(xyz.y), fz = lab_root(xyz.z);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

Rgba rgba_of_lab(const glm::dvec3& lab) {
    const double fy = (lab.x + 16) / 116, fx = fy + lab.y / 500, fz = fy - lab.z / 200;
    const glm::dvec3 rgb = glm::inverse(xyz_of_rgb) * (white * glm::dvec3(lab_cube(fx), lab_cube(fy), lab_cube(fz)));
    return {srgb_of(static_cast<float>(rgb.x)), srgb_of(static_cast<float>(rgb.y)), srgb_of(static_cast<float>(rgb.z)), 255};
}

}   // namespace render
