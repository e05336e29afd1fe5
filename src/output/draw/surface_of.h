/// @file
/// Converts our meshes, values and ranges to those of the renderer.
#pragma once

#include "draw_mesh.h"
#include "mesh/triangle_mesh.h"
#include "output/draw/figure_request.h"
#include "report/document.h"
#include "report/drawn_figure.h"
#include "sheet/color_bar.h"

namespace meshfolio::output {

/// render::draw_views for a mesh that somebody named. @throws MeshError where its triangles lie over each other too often to be drawn
std::vector<render::Image> drawn_views(const render::Surface& surface, std::span<const render::View> views,
                                       const render::DrawOptions& options);

/// A view of the mesh (and of `values`, one a vertex, when given); both must outlive it.
render::Surface surface_of(const TriangleMesh& mesh, const Vector* values = nullptr);

render::Bounds bounds_of(const TriangleMesh& mesh);

/// Are all positions inside the axis-aligned pictures that are framed on these bounds? False if one is not finite.
bool fit_frame_of(const render::Bounds& bounds, const Positions& X);

/// @throws UsageError for an unknown colour map, naming the known ones
render::ValueRange value_range(const ColorRange& range);

/// histogram() over the range of the colours.
std::vector<double> histogram_of(const std::vector<double>& values, const render::ValueRange& range);

/// With the histogram of the range's own sample, and with the isolines in its words.
render::ColorBar color_bar_of(const ColorRange& range, bool has_undefined, const render::DrawOptions& drawn);

/// Of a panel with a range of its own, in the line of its label.
render::ColorBar small_bar_of(const ColorRange& range);

/// "#1f9e89"
std::string hex_of(render::Rgba color);

/// The legend of a page, from a colour bar.
report::Legend legend_of(const render::ColorBar& bar);

}   // namespace meshfolio::output
