/// @file
/// Arranges the pictures of a figure on its sheet.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "output/draw/figure_request.h"
#include "scene/camera.h"
#include "sheet/figure_sheet.h"

namespace meshfolio::output {

/// Returns the six views along the axes: +x +y +z, then -x -y -z.
std::vector<render::View> views_in_reading_order(const render::Sight& sight);

/// Pictures of one mesh: from three quarters, then perhaps the six views in reading order. A flat mesh has the view of its front alone, an
/// empty cell of a matrix has none.
using PanelPictures = std::vector<std::shared_ptr<const render::Image>>;

/// Returns the sheet of a figure: its pictures, panel after panel, with all labels and heads, title and colour bar.
/// @param em    text size [pixels]
/// @param cell  width of a cell of a grid [pixels]; 0: as pictures and words need
render::FigureSheet sheet_of(const FigureRequest& request, const std::vector<PanelPictures>& panels, double em, int cell = 0);

/// Returns the gap between pictures of a sheet [pixels].
int gap_of(const FigureRequest& request, double em);

/// Returns the number of panels in a line of the sheet: of a matrix its columns, 1 with six views, else `in_a_line`; if that is 0, at most
/// 4 (in a gallery 6).
int panels_in_a_line(const FigureRequest& request);

/// Returns the addition to the label of a flat panel: "seen from +z; its other views are edge-on".
std::string flat_panel_note(const render::View& view);

/// True if the figure has more than twelve panels, and neither six views nor heads; its pictures are small, six in a line.
bool is_gallery(const FigureRequest& request);

}   // namespace meshfolio::output
