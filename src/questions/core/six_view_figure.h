/// @file
/// Figures of meshes from the six directions, as block of a section and as request to the renderer at once.
#pragma once

#include <string>
#include <vector>

#include "questions/core/chapter.h"

namespace meshfolio {

struct SixViewFigure {
    std::string id = {};                      // "q1_plane_h"
    std::string title = {}, subtitle = {};    // set in the picture
    std::string caption = {};                 // says what to see
    std::vector<output::Panel> panels = {};   // one: a 2 × 3 sheet; several share camera, scale and range
    std::optional<output::ColorRange> range = {};
    bool edges = false, coarse_edges = false;
    int frame_panel = 0;       // −1: frame on all panels
    int states = 1;            // of each mesh, one panel behind the other
    bool turnable = false;     // readers of the page can turn the first panel in three dimensions
    bool view_files = false;   // the assignment asks for these pictures: each view is a file as well
    output::Layout layout = output::Layout::six_views;
};

/// Appends the figure to the section, with an alternative text made from the data, and asks for its pictures.
void add_figure(Answer& answer, SixViewFigure figure);

/// "lily.obj, 1284 vertices".
std::string subtitle_of(const LibraryMesh& mesh);

/// A panel of the library's own mesh; of other positions or another mesh.
output::Panel panel_of(const LibraryMesh& mesh, std::string name, std::string label, Vector values = {});
output::Panel panel_of(TriangleMesh mesh, std::string name, std::string label, Vector values = {});

}   // namespace meshfolio
