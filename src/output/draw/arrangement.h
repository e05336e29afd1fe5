/// @file
/// Where the pictures of a figure lie in its sheet.
#pragma once

#include <vector>

#include "output/draw/figure_request.h"
#include "scene/camera.h"
#include "sheet/figure_sheet.h"

namespace meshfolio::output {

/// +x +y +z, then what is seen from behind.
std::vector<render::View> views_in_reading_order();

/// Of one mesh: from three quarters and, in the order above, from the six directions; none: an empty cell of a matrix.
using PanelPictures = std::vector<render::Image>;

/// Pictures and words in their places, the pictures panel after panel. Sheets are read alone, so that everything is named in them.
/// @param em  text size
render::FigureSheet arranged(const FigureRequest& request, std::vector<PanelPictures> panels, double em);

/// How many lie beside each other.
int panels_in_a_line(const FigureRequest& request);

/// Small multiples so many that they are looked at together and not one by one: six in a line, and small.
bool is_gallery(const FigureRequest& request);

}   // namespace meshfolio::output
