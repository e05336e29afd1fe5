/// @file
/// The SVG elements plots are made of.
#pragma once

#include <string>

#include "report/plot_labels.h"

namespace meshfolio::report {

/// A coordinate to a tenth of a pixel.
std::string px(double x);

/// Text of any kind, made safe; symbols such as λ_crit get their index lowered. `anchor`: start, middle or end.
std::string text_element(Point at, const std::string& anchor, const std::string& text, const std::string& more = "");

std::string line_element(Point a, Point b, const std::string& attributes);

/// Disc, square, triangle, diamond, cross or plus, for shape 0 to 5.
std::string point_shape(Point p, int shape, const std::string& color);

}   // namespace meshfolio::report
