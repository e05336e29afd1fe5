/// @file
/// Labels of views: the name beside a small tripod that shows the directions of x, y and z.
#pragma once

#include <string_view>

#include "scene/sight.h"
#include "sheet/drawing.h"

namespace render {

/// Returns the width of a view's label with text of size `em` [pixels], including the tripod if it gets one.
double view_label_width(std::string_view view, double em);
/// Returns the height of labels with text of size `em` [pixels].
double view_label_height(double em);

/// Adds a label with its middle at (x, y). Names other than "+x", "-x" … "-z" get no tripod; "hero" is written as "three-quarter view".
void add_view_label(Drawing& drawing, double x, double y, std::string_view view, double em, Rgba ink, Up up = Up::y);

}   // namespace render
