#include "output/draw/draw_figures.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/parallel_tasks.h"
#include "draw_mesh.h"
#include "output/draw/draw_models.h"
#include "output/draw/finished_picture.h"
#include "output/draw/robust_range.h"
#include "output/draw/surface_of.h"
#include "output/publish/folder_system.h"
#include "png/png.h"
#include "sheet/contact_sheet.h"

namespace meshfolio::output {

namespace {

/// A figure while its panels are being drawn: only the small pictures of the sheet are kept.
struct FigureJob {
    const FigureRequest* request = nullptr;
    render::DrawOptions options;
    std::vector<render::SheetRow> rows;
    std::vector<Preview> previews;   // of the panels of a comparison
    std::atomic<int> panels_left = 0;
    report::DrawnFigure drawn;
};

/// So many small multiples that they are looked at together and not one by one: six in a line, drawn at half the size, which leaves lines
/// on the surface thick enough to be seen.
bool is_gallery(const FigureRequest& request) {
    return request.layout != Layout::six_views && request.panels.size() > static_cast<std::size_t>(render::largest_block);
}

int cell_of(const FigureRequest& request, const DrawSettings& settings) {
    const bool large = request.panels.size() == 1 || (request.layout != Layout::six_views && !is_gallery(request));
    return std::min(large ? settings.sheet_cell : settings.strip_cell, is_gallery(request) ? (settings.width + 1) / 2 : settings.width);
}

/// Names become files: unique in the whole report, and nothing but a name.
void require_good_names(std::span<const FigureRequest> requests) {
    std::set<std::string> names;
    const auto require = [&](const std::string& name) {
        if (!is_safe_name(name)) throw std::logic_error("figure name '" + printable(name) + "' is not a plain file name");
        if (!names.insert(name).second) throw std::logic_error("two figures are named " + name);
    };
    for (const FigureRequest& request : requests) {
        require(request.id + "_sheet");
        for (const Panel& panel : request.panels) require(panel.name);
        if (request.panels.empty()) throw std::logic_error("figure " + request.id + " has no panel");
        if (request.frame_panel >= static_cast<int>(request.panels.size())) {
            throw std::logic_error("figure " + request.id + " is framed on a panel it has not");
        }
        if (request.layout == Layout::comparison && request.panels.size() != 2 && request.panels.size() != 3)
            throw std::logic_error("figure " + request.id + " compares neither two panels nor three");
    }
}

/// The box all panels are framed on, so that they share one scale.
render::Bounds framed_box(const FigureRequest& request) {
    if (request.frame_panel >= 0) return bounds_of(*request.panels[static_cast<std::size_t>(request.frame_panel)].mesh);
    render::Bounds box = bounds_of(*request.panels.front().mesh);
    for (const Panel& panel : request.panels) {
        const render::Bounds other = bounds_of(*panel.mesh);
        box.low = glm::min(box.low, other.low);
        box.high = glm::max(box.high, other.high);
    }
    return box;
}

/// In which the panels that have to be seen fill the picture.
render::Frame three_quarter_frame(const FigureRequest& request, const render::DrawOptions& options) {
    std::vector<glm::dvec3> positions;
    std::vector<glm::ivec3> triangles;
    for (std::size_t p = 0; p < request.panels.size(); ++p) {
        if (request.frame_panel >= 0 && p != static_cast<std::size_t>(request.frame_panel)) continue;
        const render::Surface surface = surface_of(*request.panels[p].mesh);
        const int offset = static_cast<int>(positions.size());
        positions.insert(positions.end(), surface.positions.begin(), surface.positions.end());
        for (const glm::ivec3& t : surface.triangles) triangles.push_back(t + offset);
    }
    return render::frame_of(positions, triangles, render::three_quarter_view(), options.width, options.height, options.fill);
}

render::DrawOptions options_of(const FigureRequest& request, const DrawSettings& settings) {
    render::DrawOptions options;
    options.width = is_gallery(request) ? (settings.width + 1) / 2 : settings.width;
    options.height = is_gallery(request) ? (settings.height + 1) / 2 : settings.height;
    if (request.layout == Layout::comparison) options.height = static_cast<int>(comparison_share * settings.height);
    options.edges = request.edges;
    options.isoline_spacing = request.isoline_spacing;
    if (request.layout == Layout::six_views)
        options.frame = render::frame_of(framed_box(request), options.width, options.height, options.fill);
    else if (request.layout != Layout::multiples)
        options.frame = three_quarter_frame(request, options);
    if (request.range) options.range = value_range(*request.range);
    return options;
}

std::vector<render::View> views_of(const FigureRequest& request) {
    if (request.layout != Layout::six_views) return {render::three_quarter_view()};
    return {render::six_views.begin(), render::six_views.end()};
}

std::string view_file(const Panel& panel, const render::View& view) {
    return "images/" + panel.name + "_" + std::string(view.name) + ".png";
}

bool has_undefined(const FigureRequest& request) {
    for (const Panel& panel : request.panels) {
        if (panel.values.array().isNaN().any()) return true;
    }
    return false;
}

render::ColorBar legend_of(const FigureJob& job) {
    return color_bar_of(*job.request->range, has_undefined(*job.request), job.options.undefined_color);
}

/// Six pictures into files; the sheet keeps them small.
void draw_panel(FigureJob& job, std::size_t index, const std::filesystem::path& folder, const DrawSettings& settings) {
    const Panel& panel = job.request->panels[index];
    render::DrawOptions options = job.options;
    options.marked_vertices = panel.marked_vertices;
    const bool colored = panel.values.size() > 0 && job.request->range.has_value();
    const std::vector<render::View> directions = views_of(*job.request);
    std::vector<render::Image> views = render::draw_views(surface_of(*panel.mesh, colored ? &panel.values : nullptr), directions, options);
    const int cell = cell_of(*job.request, settings);
    render::SheetRow& row = job.rows[index];
    row.label = job.request->panels.size() > 1 ? panel.label : "";
    row.pictures.resize(views.size());
    for_each_task(views.size(), [&](std::size_t i) {
        row.pictures[i] = render::shrink(views[i], cell, cell * views[i].height / views[i].width);
        label_view(views[i], directions[i].name);
        if (job.request->layout == Layout::comparison) {
            const render::ColorBar bar = colored ? legend_of(job) : render::ColorBar{};
            views[i] = with_room_below(views[i], settings.height, colored ? &bar : nullptr);
            job.previews[index] = preview_of(views[i], settings.panel_width, settings.jpeg_quality);
        }
        write_file(folder / view_file(panel, directions[i]), render::encode_png(views[i]));
        views[i] = {};
    });
}

/// One picture a panel: small multiples, side by side and named below, rather than a row each.
void fold_into_grid(render::ContactSheet& sheet) {
    render::SheetRow all;
    for (render::SheetRow& row : sheet.rows) {
        sheet.view_names.push_back(std::move(row.label));
        std::move(row.pictures.begin(), row.pictures.end(), std::back_inserter(all.pictures));
    }
    sheet.rows = {std::move(all)};
}

void draw_sheet(FigureJob& job, const std::filesystem::path& folder, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    render::ContactSheet sheet;
    sheet.title = request.title;
    sheet.subtitle = request.subtitle;
    if (request.layout == Layout::six_views)
        for (const render::View& view : render::six_views) sheet.view_names.emplace_back(view.name);
    sheet.rows = std::move(job.rows);
    if (request.layout != Layout::six_views && request.panels.size() > 1) fold_into_grid(sheet);
    if (request.range) {
        sheet.color_bar = legend_of(job);
        // of these panels: several figures may share a range
        sheet.color_bar->histogram = histogram(finite_values(request.panels), request.range->low, request.range->high);
    }
    const render::Image image = render::compose(sheet);
    job.drawn.sheet = "images/" + request.id + "_sheet.png";
    write_file(folder / job.drawn.sheet, render::encode_png(image));

    if (settings.on_paper.contains(request.id)) job.drawn.print_jpeg = render::encode_jpeg(image, settings.print_quality);
    Preview preview = preview_of(image, settings.preview_width, settings.jpeg_quality);
    job.drawn.width = preview.width;
    job.drawn.height = preview.height;
    job.drawn.preview_jpeg = std::move(preview.jpeg);
}

void name_views(FigureJob& job) {
    for (const Panel& panel : job.request->panels) {
        for (const render::View& view : views_of(*job.request)) {
            const std::string prefix = job.request->panels.size() > 1 ? panel.label + ", " : "";
            job.drawn.views.emplace_back(prefix + std::string(view.name), view_file(panel, view));
        }
    }
}

void name_comparison(FigureJob& job) {
    for (std::size_t p = 0; p < job.previews.size(); ++p) {
        const Panel& panel = job.request->panels[p];
        Preview& preview = job.previews[p];
        job.drawn.comparison.push_back(
            {panel.label, view_file(panel, render::three_quarter_view()), std::move(preview.jpeg), preview.width, preview.height});
    }
}

/// One panel of one figure: what is drawn in parallel.
struct Piece {
    std::size_t figure, panel;
};

}   // namespace

report::DrawnFigures draw_figures(std::span<const FigureRequest> requests, const std::filesystem::path& folder,
                                  const DrawSettings& settings, const std::function<void(double)>& progress) {
    require_good_names(requests);
    make_folder(folder / "images");

    std::vector<FigureJob> figures(requests.size());
    std::vector<Piece> pieces;
    for (std::size_t f = 0; f < requests.size(); ++f) {
        figures[f].request = &requests[f];
        figures[f].options = options_of(requests[f], settings);
        figures[f].rows.resize(requests[f].panels.size());
        figures[f].previews.resize(requests[f].layout == Layout::comparison ? requests[f].panels.size() : 0);
        figures[f].panels_left = static_cast<int>(requests[f].panels.size());
        for (std::size_t p = 0; p < requests[f].panels.size(); ++p) pieces.push_back({f, p});
    }
    std::mutex telling;
    std::size_t drawn = 0;
    const auto draw_piece = [&](std::size_t i) {
        // Isolated: a thread that waits for the views of this panel does not begin another one, so that at most one panel a thread is
        // in memory at full size.
        tbb::this_task_arena::isolate([&] {
            FigureJob& job = figures[pieces[i].figure];
            draw_panel(job, pieces[i].panel, folder, settings);
            if (--job.panels_left == 0) draw_sheet(job, folder, settings);
        });
        const std::lock_guard lock(telling);
        if (progress) progress(static_cast<double>(++drawn) / static_cast<double>(pieces.size()));
    };
    tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
    arena.execute([&] { for_each_task(pieces.size(), draw_piece); });

    report::DrawnFigures all;
    for (FigureJob& job : figures) {
        name_views(job);
        name_comparison(job);
        all.emplace(job.request->id, std::move(job.drawn));
    }
    add_models(requests, folder, all);
    return all;
}

}   // namespace meshfolio::output
