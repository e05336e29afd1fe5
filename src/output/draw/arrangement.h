/// @file
/// Arranges the pictures of a figure in its sheet.
#pragma once

#include <string>
#include <vector>

#include "output/draw/figure_request.h"
#include "scene/camera.h"
#include "sheet/figure_sheet.h"

namespace meshfolio::output {

/// +x +y +z, then the views from behind.
std::vector<render::View> views_in_reading_order();

/// Pictures of one mesh: the three-quarter view, then perhaps the six views in the order above. None: an empty cell of a matrix.
using PanelPictures = std::vector<render::Image>;

/// Places pictures, panel after panel, and words. Sheets are read alone, so that everything is labelled in them.
/// @param em  text size
render::FigureSheet arranged(const FigureRequest& request, std::vector<PanelPictures> panels, double em);

int panels_in_a_line(const FigureRequest& request);

/// What the label of a flat panel adds: "seen from +z; its other views are edge-on".
std::string words_of_flat(const render::View& view);

/// Has the figure so many small multiples that they are drawn small, six in a line?
bool is_gallery(const FigureRequest& request);

}   // namespace meshfolio::output
