/// @file
/// The name of a view beside a small tripod that shows where x, y and z point in it.
#pragma once

#include <string_view>

#include "scene/image.h"

namespace render {

/// Size of a label for text of size `em`.
double view_label_width(std::string_view view, double em);
double view_label_height(double em);

/// Draws round the middle (x, y). Names other than those of the six views get no tripod.
void draw_view_label(Image& image, double x, double y, std::string_view view, double em, Rgba ink);

}   // namespace render
