/// @file
/// The pictures of a panel, which the sheets of reports and drawings of one's own share.
#pragma once

#include "draw_mesh.h"
#include "output/draw/figure_request.h"
#include "sheet/drawing.h"

namespace meshfolio::output {

/// Returns the surface of a panel, with its values if it has a range of colours. The panel must outlive it.
render::Surface surface_in(const FigureRequest& request, const Panel& panel);

/// Returns the options of all pictures of a panel, without size and frame.
render::DrawOptions options_of(const FigureRequest& request, const Panel& panel);

/// The look of a drawing; lengths in pixels.
struct DrawingLook {
    int width = 0;     // of the whole
    double em = 16;    // of text
    double line = 1;   // width of isolines
    bool bar = true, edges = false;
    render::Rgba background{255, 255, 255, 255};
};

/// Draws the panels of a figure from three quarters, or as their own views, with labels and colour bar. Isolines are paths, not pixels.
/// @throws UsageError if the pictures would be smaller than 16 pixels or wider than 8192
/// @throws MeshError if too many large triangles of a mesh lie over each other
render::Drawing drawing_of(const FigureRequest& request, const DrawingLook& look);

}   // namespace meshfolio::output
