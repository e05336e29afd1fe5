/// @file
/// Figures of meshes: the block of a section, and the request to the renderer.
#pragma once

#include <string>

#include "questions/core/chapter.h"

namespace meshfolio {

/// Appends the figure to the section and asks for its pictures. The alternative text is made from title, panels and colours.
void add_figure(Answer& answer, output::FigureRequest request, std::string caption);
void add_figure(Answer& answer, output::FigureRequest request, std::string caption, std::string alt);

/// "lily.obj, 1284 vertices".
std::string subtitle_of(const LibraryMesh& mesh);

/// A panel of the library's own mesh; of other positions or another mesh.
output::Panel panel_of(const LibraryMesh& mesh, std::string name, std::string label, Vector values = {});
output::Panel panel_of(TriangleMesh mesh, std::string name, std::string label, Vector values = {});

/// The positions about the centre of the mesh's box, in its diagonals, so that meshes of any size can stand side by side.
TriangleMesh in_unit_box(const TriangleMesh& mesh, const Positions& X);

}   // namespace meshfolio
