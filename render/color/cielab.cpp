#include "color/cielab.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "color/srgb.h"

namespace render {

namespace {

constexpr glm::dvec3 white{0.95047, 1, 1.08883};

/// Linear sRGB to XYZ (IEC 61966-2-1), written by columns.
const glm::dmat3 xyz_of_rgb{0.4124564, 0.2126729, 0.0193339, 0.3575761, 0.7151522, 0.1191920, 0.1804375, 0.0721750, 0.9503041};

constexpr double epsilon = 216.0 / 24389, kappa = 24389.0 / 27;

double f(double t) { return t > epsilon ? std::cbrt(t) : (kappa * t + 16) / 116; }
double f_inverse(double u) { return u * u * u > epsilon ? u * u * u : (116 * u - 16) / kappa; }

}   // namespace

glm::dvec3 lab_of(Rgba color) {
    const glm::dvec3 xyz = xyz_of_rgb * glm::dvec3(linear_of(color.r), linear_of(color.g), linear_of(color.b)) / white;
    const double fx = f(xyz.x), fy = f(xyz.y), fz = f(xyz.z);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

Rgba rgba_of_lab(const glm::dvec3& lab) {
    const double fy = (lab.x + 16) / 116, fx = fy + lab.y / 500, fz = fy - lab.z / 200;
    const glm::dvec3 rgb = glm::inverse(xyz_of_rgb) * (white * glm::dvec3(f_inverse(fx), f_inverse(fy), f_inverse(fz)));
    return {srgb_of(static_cast<float>(rgb.x)), srgb_of(static_cast<float>(rgb.y)), srgb_of(static_cast<float>(rgb.z)), 255};
}

}   // namespace render
