/// @file
/// Antialiased lines and areas for the furniture of a figure. Coordinates in pixels; the middle of the first pixel is (½, ½).
#pragma once

#include <glm/vec2.hpp>

#include "scene/image.h"

namespace render {

/// `ink` covering this share of `ground`. The 8-bit channels are mixed: in linear light dark strokes on white would look thin.
Rgba inked(Rgba ground, Rgba ink, float coverage);

/// A line with round ends.
void draw_line(Image& image, glm::dvec2 a, glm::dvec2 b, double width, Rgba color);
void draw_ring(Image& image, glm::dvec2 centre, double radius, double width, Rgba color);
/// Pixels x0 ≤ x < x1, y0 ≤ y < y1.
void fill_rectangle(Image& image, int x0, int y0, int x1, int y1, Rgba color);

}   // namespace render
