/// @file
/// Finishes drawn pictures: the label of the view, the JPEG for page and paper.
#pragma once

#include <string_view>

#include "report/document.h"
#include "report/drawn_figure.h"
#include "scene/image.h"

namespace meshfolio::output {

/// Labels a picture with its view and axes, in the corner where they hide least. Pictures below 100 pixels and three-quarter views are not
/// labelled.
void label_view(render::Image& picture, std::string_view view);

/// Cuts out a rectangle; outside of the picture it is white.
render::Image part_of(const render::Image& picture, int left, int top, int width, int height);

/// The JPEGs of a figure, from the sheet as it was drawn or as read back from its PNG: the same bytes.
/// @return false if a picture is not inside the sheet
bool cut_pictures(const render::Image& sheet, report::DrawnFigure& figure);

}   // namespace meshfolio::output
