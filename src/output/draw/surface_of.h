/// @file
/// Conversions of our meshes, values and ranges to those of the renderer.
#pragma once

#include "draw_mesh.h"
#include "mesh/triangle_mesh.h"
#include "output/draw/figure_request.h"
#include "report/document.h"
#include "report/drawn_figure.h"
#include "sheet/color_bar.h"

namespace meshfolio::output {

/// Returns the pictures of render::draw_views(), one a view. @throws MeshError if too many large triangles of the mesh lie over each other
std::vector<render::Image> drawn_views(const render::Surface& surface, std::span<const render::View> views,
                                       const render::DrawOptions& options);

/// Returns a surface that refers to the mesh and to `values` (one a vertex; null: none), which must outlive it.
render::Surface surface_of(const TriangleMesh& mesh, const Vector* values = nullptr);

/// Returns the box of the mesh's drawable triangles.
render::Bounds bounds_of(const TriangleMesh& mesh);

/// True if all positions are finite and inside the pictures along the axes that are framed on these bounds.
bool fits_frame(const render::Bounds& bounds, const Positions& X);

/// Returns the colour map of a range. @throws UsageError with the known colour maps if the name is unknown
const render::Colormap& colormap_of(const ColorRange& range);
/// Returns a range for the renderer. @throws UsageError as colormap_of()
render::ValueRange value_range(const ColorRange& range);

/// Returns the histogram() of the values over the range, of their logarithms if it is logarithmic.
std::vector<double> histogram_of(const std::vector<double>& values, const render::ValueRange& range);

/// Returns the colour bar of a range, with the histogram of its sample and a note on the isolines of `drawn`.
render::ColorBar color_bar_of(const ColorRange& range, bool has_undefined, const render::DrawOptions& drawn);

/// Returns the colour bar of a range without isolines and undefined values, for the label of a panel with its own range.
render::ColorBar small_bar_of(const ColorRange& range);

/// Returns "#1f9e89" for red 0x1f, green 0x9e, blue 0x89.
std::string hex_of(render::Rgba color);

/// Returns a colour bar as the legend of a page, with 48 colours from low to high.
report::Legend legend_of(const render::ColorBar& bar);

}   // namespace meshfolio::output
