/// @file
/// Antialiased lines and areas. Coordinates are in pixels; the middle of the first pixel is (½, ½).
#pragma once

#include <glm/vec2.hpp>

#include "scene/image.h"

namespace render {

/// Returns the colour of a pixel `ground` with the share `coverage` (0 to 1) under `ink`. Mixes 8-bit channels, because in linear light
/// dark strokes on white look thin.
Rgba inked(Rgba ground, Rgba ink, float coverage);

/// Draws a line from a to b with round ends.
void draw_line(Image& image, glm::dvec2 a, glm::dvec2 b, double width, Rgba color);
/// Draws a circle of this radius with a line of this width.
void draw_ring(Image& image, glm::dvec2 centre, double radius, double width, Rgba color);
/// Fills the pixels x0 ≤ x < x1, y0 ≤ y < y1.
void fill_rectangle(Image& image, int x0, int y0, int x1, int y1, Rgba color);

}   // namespace render
