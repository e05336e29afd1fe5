/// @file
/// Figures of meshes: the block of a section, and the request to the renderer.
#pragma once

#include <string>

#include "questions/core/chapter.h"

namespace meshfolio {

/// Appends a figure with this caption to answer.section, and the request to answer.figures. Without `alt`, the alternative text is made of
/// title, panels and colour range.
void add_figure(Answer& answer, output::FigureRequest request, std::string caption);
void add_figure(Answer& answer, output::FigureRequest request, std::string caption, std::string alt);

/// Returns the file name and the number of vertices: "lily.obj, 1284 vertices".
std::string subtitle_of(const LibraryMesh& mesh);

/// Makes a panel of a mesh of the library, which is not copied, or of another mesh. @param values  n values to colour; empty: none
output::Panel panel_of(const LibraryMesh& mesh, std::string name, std::string label, Vector values = {});
output::Panel panel_of(TriangleMesh mesh, std::string name, std::string label, Vector values = {});

/// Returns the triangles of `mesh` with positions (X − centre)/diagonal, centre and diagonal of the bounding box of `mesh`, so that meshes
/// of any size can stand side by side.
TriangleMesh in_unit_box(const TriangleMesh& mesh, const Positions& X);

}   // namespace meshfolio
