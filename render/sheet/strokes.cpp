#include "sheet/strokes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace render {

namespace {

/// Inks the pixels of a box by distance(pixel) to a stroke: fully within half its width, fading over one pixel.
template <class Distance> void draw_stroke(Image& image, glm::dvec2 low, glm::dvec2 high, double width, Rgba color, Distance distance) {
    const double reach = width / 2 + 1;
    const int x0 = std::max(0, static_cast<int>(low.x - reach)), x1 = std::min(image.width - 1, static_cast<int>(high.x + reach));
    const int y0 = std::max(0, static_cast<int>(low.y - reach)), y1 = std::min(image.height - 1, static_cast<int>(high.y + reach));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const double coverage = std::clamp(width / 2 + 0.5 - distance(glm::dvec2(x + 0.5, y + 0.5)), 0.0, 1.0);
            image.at(x, y) = inked(image.at(x, y), color, static_cast<float>(coverage));
        }
}

}   // namespace

Rgba inked(Rgba ground, Rgba ink, float coverage) {
    const float a = coverage * static_cast<float>(ink.a) / 255;
    if (a <= 0) return ground;
    if (ground.a == 0) return {ink.r, ink.g, ink.b, static_cast<std::uint8_t>(std::lround(255 * a))};
    const auto mixed = [a](int from, int to) {
        return static_cast<std::uint8_t>(std::lround(static_cast<float>(from) + a * static_cast<float>(to - from)));
    };
    return {mixed(ground.r, ink.r), mixed(ground.g, ink.g), mixed(ground.b, ink.b), mixed(ground.a, 255)};
}

void draw_line(Image& image, glm::dvec2 a, glm::dvec2 b, double width, Rgba color) {
    const glm::dvec2 along = b - a;
    const double length2 = std::max(glm::dot(along, along), 1e-12);
    draw_stroke(image, glm::min(a, b), glm::max(a, b), width, color, [&](glm::dvec2 p) {
        const double t = std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0);
        return glm::length(p - a - t * along);
    });
}

void draw_ring(Image& image, glm::dvec2 centre, double radius, double width, Rgba color) {
    draw_stroke(image, centre - radius, centre + radius, width, color,
                [&](glm::dvec2 p) { return std::abs(glm::length(p - centre) - radius); });
}

void fill_rectangle(Image& image, int x0, int y0, int x1, int y1, Rgba color) {
    for (int y = std::max(0, y0); y < std::min(y1, image.height); ++y)
        for (int x = std::max(0, x0); x < std::min(x1, image.width); ++x) image.at(x, y) = inked(image.at(x, y), color, 1);
}

}   // namespace render
