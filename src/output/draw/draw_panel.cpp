#include "output/draw/draw_panel.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/errors.h"
#include "base/parallel_tasks.h"
#include "output/draw/arrangement.h"
#include "output/draw/framing.h"
#include "output/draw/surface_of.h"
#include "scene/isolines.h"

namespace meshfolio::output {

namespace {

constexpr int smallest_picture = 16, largest_picture = 8192;   // [pixels]
constexpr double tallest = 1.3;                                // height of a picture over its width
constexpr render::Rgba line_color{34, 34, 40, 255};

bool has_values(const FigureRequest& request, const Panel& panel) { return panel.values.size() > 0 && request.range_of(panel) != nullptr; }

/// Returns the frames with which pictures are `width` pixels wide, or less if they would be too tall.
std::vector<PictureFrame> frames_of_width(const FigureRequest& request, int width) {
    const std::vector<PictureFrame> square = three_quarter_frames(request, width);
    const double growth = std::min(double(width) / square[0].width, tallest * width / square[0].height);
    const int side = static_cast<int>(std::min(growth * width, double(largest_picture)));
    std::vector<PictureFrame> frames = three_quarter_frames(request, side);
    for (PictureFrame& frame : frames) frame.width = std::min(frame.width, width);
    return frames;
}

/// Returns the visible isolines of a picture as paths from its upper left corner.
render::Drawing lines_of(const render::Surface& surface, const render::View& view, const render::DrawOptions& options, double width) {
    render::Drawing lines;
    for (std::vector<glm::dvec2>& points : render::visible_isolines(surface, view, options))
        lines.items.emplace_back(render::Drawing::Path{std::move(points), width, line_color});
    return lines;
}

}   // namespace

render::Surface surface_in(const FigureRequest& request, const Panel& panel) {
    return surface_of(*panel.mesh, has_values(request, panel) ? &panel.values : nullptr);
}

render::DrawOptions options_of(const FigureRequest& request, const Panel& panel) {
    constexpr Eigen::Index coarse_mesh = 3000;   // triangles below which a shape cannot be seen without its edges
    const bool is_coarse = panel.mesh->face_count() < coarse_mesh, has_six_views = request.layout == Layout::six_views;
    render::DrawOptions options;
    options.edges = request.edges || (is_coarse && (request.coarse_edges || (!has_values(request, panel) && !has_six_views)));
    options.isoline_spacing = request.isoline_spacing;
    options.marked_vertices = panel.marked_vertices;
    if (const ColorRange* range = request.range_of(panel)) options.range = value_range(*range);
    return options;
}

render::Drawing drawing_of(const FigureRequest& request, const DrawingLook& look) {
    const int columns = panels_in_a_line(request), gap = gap_of(request, look.em);
    const int width = (look.width - (columns - 1) * gap) / columns;
    if (width < smallest_picture || width > largest_picture)
        throw UsageError("the pictures of the figure would be " + std::to_string(width) + " pixels wide",
                         "take another --width-mm, --dpi or --columns; they have 16 to 8192 pixels");
    const std::vector<PictureFrame> frames = frames_of_width(request, width);
    std::vector<PanelPictures> pictures(request.panels.size());
    std::vector<render::Drawing> lines(request.panels.size());
    for_each_task(request.panels.size(), [&](std::size_t p) {
        const Panel& panel = request.panels[p];
        const render::Surface surface = surface_in(request, panel);
        render::DrawOptions options = options_of(request, panel);
        options.width = frames[p].width;
        options.height = frames[p].height;
        options.frame = frames[p].frame;
        options.background = look.background;
        options.edges = look.edges;
        if (options.isoline_spacing > 0 && !surface.values.empty()) lines[p] = lines_of(surface, frames[p].view, options, look.line);
        options.isoline_spacing = 0;
        pictures[p] = {std::make_shared<render::Image>(std::move(drawn_views(surface, std::span(&frames[p].view, 1), options).front()))};
    });
    render::FigureSheet sheet = sheet_of(request, pictures, look.em, width);
    if (!look.bar) sheet.color_bar.reset();
    sheet.least_width = look.width;
    sheet.margin = 0;
    sheet.background = look.background;
    render::SheetDrawing drawn = render::drawing_of(sheet);
    for (std::size_t p = 0; p < lines.size(); ++p)
        drawn.drawing.add(lines[p], drawn.left + sheet.pictures[p].left, drawn.top + sheet.pictures[p].top);
    return std::move(drawn.drawing);
}

}   // namespace meshfolio::output
