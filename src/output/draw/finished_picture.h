/// @file
/// Finishing of drawn pictures: the label of the view, the JPEG for page and paper.
#pragma once

#include <string_view>

#include "report/document.h"
#include "report/drawn_figure.h"
#include "scene/image.h"
#include "scene/sight.h"

namespace meshfolio::output {

/// Labels a picture with the name of its view ("+x") and its axes, in the corner where they hide least. Leaves other views
/// and pictures of less than 100 pixels as they are.
void label_view(render::Image& picture, std::string_view view, const render::Sight& sight);

/// Cuts out a rectangle, which is white where it extends beyond the picture.
render::Image part_of(const render::Image& picture, int left, int top, int width, int height);

/// Sets the JPEG of each picture of a figure, cut from its sheet. False, with nothing set, if a picture is not inside the sheet.
bool cut_pictures(const render::Image& sheet, report::DrawnFigure& figure);

}   // namespace meshfolio::output
