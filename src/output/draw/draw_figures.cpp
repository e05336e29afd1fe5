#include "output/draw/draw_figures.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/at.h"
#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/parallel_tasks.h"
#include "draw_mesh.h"
#include "output/draw/arrangement.h"
#include "output/draw/draw_models.h"
#include "output/draw/draw_panel.h"
#include "output/draw/figure_request.h"
#include "output/draw/finished_picture.h"
#include "output/draw/framing.h"
#include "output/draw/surface_of.h"
#include "output/publish/folder_system.h"
#include "png/png.h"

namespace meshfolio::output {

namespace {

/// A figure while its panels are drawn.
struct FigureJob {
    const FigureRequest* request = nullptr;
    std::vector<PictureFrame> three_quarters;   // one a panel
    std::vector<SixFrames> six;                 // one a panel if there are six views
    std::vector<PanelPictures> pictures;        // one a panel
    std::atomic<int> panels_left = 0;
    report::DrawnFigure drawn;
};

/// Sizes of pictures in sheets [pixels]: two to three times their size on paper, about their size on the page.
constexpr int leading = 600, beside_leading = 270, in_a_row = 216, in_a_strip = 400, line_of_pictures = 1280, smallest_in_a_line = 192;

bool has_six_views(const FigureRequest& request) { return request.layout == Layout::six_views; }

double scale_of(const DrawSettings& settings) { return std::min({1.0, settings.width / 800.0, settings.height / 800.0}); }
int scaled(int side, const DrawSettings& settings) { return std::max(8, static_cast<int>(std::lround(side * scale_of(settings)))); }

/// Requires a mesh in every panel, except in the cells of a matrix, and heads that fit the panels.
void require_meshes(const FigureRequest& request) {
    const std::size_t panels = request.panels.size(), columns = request.columns.size(), rows = request.rows.size();
    const auto refuse = [&](const char* why) { throw std::logic_error("figure " + request.id + " " + why); };
    const auto has_mesh = [](const Panel& panel) { return panel.mesh != nullptr; };
    const bool is_matrix = columns > 0 || rows > 0;
    if (std::ranges::none_of(request.panels, has_mesh)) refuse("has no panel");
    if (!is_matrix && !std::ranges::all_of(request.panels, has_mesh)) refuse("has a panel without a mesh");
    if (is_matrix && has_six_views(request)) refuse("has heads and six views");
    if ((columns > 0 && panels % columns != 0) || (rows > 0 && panels % rows != 0) || (columns > 0 && rows > 0 && panels != columns * rows))
        refuse("has a number of panels that does not fit its heads");
    if (request.frame_panel >= static_cast<int>(panels) || (request.frame_panel >= 0 && !has_mesh(request.panels[at(request.frame_panel)])))
        refuse("is framed on a panel that does not exist");
}

/// Requires names that are unique in the whole report and usable as names of files.
void require_good_names(std::span<const FigureRequest> requests) {
    std::set<std::string> names;
    const auto require = [&](const std::string& name) {
        if (!is_safe_name(name)) throw std::logic_error("figure name '" + printable(name) + "' is not a plain file name");
        if (!names.insert(name).second) throw std::logic_error("two figures are named " + name);
    };
    for (const FigureRequest& request : requests) {
        require(request.id + "_sheet");
        for (const Panel& panel : request.panels)
            if (panel.mesh) require(panel.name);
        require_meshes(request);
    }
}

std::string view_file(const Panel& panel, const render::View& view) {
    return "images/" + panel.name + "_" + std::string(view.name) + ".png";
}

/// Returns the views of a panel in the order of its pictures.
std::vector<render::View> views_of(const FigureJob& job, std::size_t index) {
    const FigureRequest& request = *job.request;
    const Panel& panel = request.panels[index];
    if (!panel.mesh) return {};
    if (const auto front = has_six_views(request) ? view_of_flat(*panel.mesh, request.sight) : std::nullopt) return {*front};
    std::vector<render::View> views{job.three_quarters[index].view};
    if (has_six_views(request)) std::ranges::copy(views_in_reading_order(request.sight), std::back_inserter(views));
    return views;
}

bool has_view_files(const FigureRequest& request, const DrawSettings& settings) {
    return settings.view_files || (request.view_files && !settings.sheets_only);
}

/// Writes the views of a panel in full size, each labelled in a corner; that from three quarters only if there is no other.
void draw_view_files(const FigureJob& job, std::size_t index, const std::filesystem::path& folder, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    const Panel& panel = request.panels[index];
    std::vector<render::View> directions = views_of(job, index);
    if (directions.size() > 1) directions.erase(directions.begin());
    render::DrawOptions options = options_of(request, panel);
    options.width = settings.width;
    options.height = settings.height;
    options.frame =
        full_frame(request, index, has_six_views(request) ? nullptr : &job.three_quarters[index].view, options.width, options.height);
    std::vector<render::Image> views = drawn_views(surface_in(request, panel), directions, options);
    for_each_task(views.size(), [&](std::size_t i) {
        label_view(views[i], directions[i].name, request.sight);
        write_file(folder / view_file(panel, directions[i]), render::encode_png(views[i]));
        views[i] = {};
    });
}

/// Draws the pictures of a panel for its sheet, and its view files.
void draw_panel(FigureJob& job, std::size_t index, const std::filesystem::path& folder, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    const Panel& panel = request.panels[index];
    if (!panel.mesh) return;
    const render::Surface surface = surface_in(request, panel);
    render::DrawOptions options = options_of(request, panel);

    const auto draw = [&](std::span<const render::View> views, const PictureFrame& frame) {
        options.width = frame.width;
        options.height = frame.height;
        options.frame = frame.frame;
        return drawn_views(surface, views, options);
    };
    const std::vector<render::View> views = views_of(job, index);
    const std::size_t large = render::is_name_of_six(views[0].name) ? 0 : 1;
    const auto keep = [&](render::Image picture) { job.pictures[index].push_back(std::make_shared<render::Image>(std::move(picture))); };
    if (large > 0) keep(std::move(draw(std::span(views).first(large), job.three_quarters[index]).front()));
    if (!job.six.empty()) {
        const std::span directions = std::span(views).subspan(large);
        const std::vector<render::Image> drawn = draw(directions, job.six[index].covering_all());
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            const PictureFrame& size = job.six[index].of(directions[i]);
            keep(part_of(drawn[i], (drawn[i].width - size.width) / 2, (drawn[i].height - size.height) / 2, size.width, size.height));
        }
    }
    if (has_view_files(request, settings)) draw_view_files(job, index, folder, settings);
}

/// Enters the labels of the panels and the places of their pictures on the sheet.
void enter_pictures(FigureJob& job, const render::FigureSheet& sheet, const render::SheetDrawing& composed, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    std::size_t next = 0;
    for (std::size_t p = 0; p < request.panels.size(); ++p) {
        report::DrawnPanel& panel = job.drawn.panels.emplace_back();
        panel.label = request.panels[p].label;
        if (request.panels[p].range) panel.legend = legend_of(small_bar_of(*request.panels[p].range));
        const std::vector<render::View> views = views_of(job, p);
        if (views.size() == 1 && render::is_name_of_six(views[0].name))
            panel.label += (panel.label.empty() ? "" : " ") + ("(" + flat_panel_note(views[0]) + ")");
        for (std::size_t i = 0; i < views.size(); ++i) {
            const render::FigureSheet::Picture& placed = sheet.pictures[next++];
            report::DrawnPicture& picture = panel.pictures.emplace_back();
            picture.view = render::is_name_of_six(views[i].name) ? std::string(views[i].name) : "";
            picture.left = composed.left + placed.left;
            picture.top = composed.top + placed.top;
            picture.width = placed.image->width;
            picture.height = placed.image->height;
            if (has_view_files(request, settings) && (i > 0 || views.size() == 1)) picture.file = view_file(request.panels[p], views[i]);
        }
    }
}

/// Composes the sheet of a figure from its pictures and writes it.
void finish_figure(FigureJob& job, const std::filesystem::path& folder, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    job.drawn.columns = request.columns;
    job.drawn.rows = request.rows;
    job.drawn.in_a_line = panels_in_a_line(request);
    job.drawn.states = request.states;
    const render::FigureSheet sheet = sheet_of(request, std::exchange(job.pictures, {}), std::max(13.0, 21 * scale_of(settings)));
    if (sheet.color_bar) job.drawn.legend = legend_of(*sheet.color_bar);
    const render::SheetDrawing composed = render::drawing_of(sheet);
    const render::Image image = render::painted(composed.drawing);
    enter_pictures(job, sheet, composed, settings);
    job.drawn.sheet = "images/" + request.id + "_sheet.png";
    write_file(folder / job.drawn.sheet, render::encode_png(image));
    cut_pictures(image, job.drawn);
}

/// Sets the frames and sizes of a figure's pictures.
void prepare(FigureJob& job, const FigureRequest& request, const DrawSettings& settings) {
    job.request = &request;
    const bool alone = request.panels.size() == 1;
    int side = std::clamp(line_of_pictures / panels_in_a_line(request), smallest_in_a_line, in_a_strip);
    if (request.panels.size() > 8) side = smallest_in_a_line;   // line below line
    if (is_gallery(request) || has_six_views(request)) side = in_a_row;
    if (alone) side = leading;
    job.three_quarters = three_quarter_frames(request, scaled(side, settings));
    for (std::size_t p = 0; has_six_views(request) && p < request.panels.size(); ++p) {
        const int beside = !alone ? in_a_row : view_of_flat(*request.panels[p].mesh, request.sight) ? leading : beside_leading;
        job.six.push_back(six_frames(request, p, scaled(beside, settings)));
    }
    job.pictures.resize(request.panels.size());
    job.panels_left = static_cast<int>(request.panels.size());
}

}   // namespace

report::DrawnFigures draw_figures(std::span<const FigureRequest> requests, const std::filesystem::path& folder,
                                  const DrawSettings& settings, const std::function<void(double share)>& progress) {
    require_good_names(requests);
    make_folder(folder / "images");
    std::map<std::string, std::vector<report::DrawnModel>> models = write_models(requests, folder);

    std::vector<FigureJob> figures(requests.size());
    struct Piece {   // one panel of one figure
        std::size_t figure, panel;
    };
    std::vector<Piece> pieces;
    for (std::size_t f = 0; f < requests.size(); ++f) {
        prepare(figures[f], requests[f], settings);
        figures[f].drawn.models = std::move(models[requests[f].id]);
        for (std::size_t p = 0; p < requests[f].panels.size(); ++p) pieces.push_back({f, p});
    }
    std::atomic<std::size_t> next = 0;
    std::mutex reporting;
    std::size_t drawn = 0;
    for_each_task(pieces.size(), [&](std::size_t) {
        const Piece piece = pieces[next++];   // in their order
        FigureJob& job = figures[piece.figure];
        // Isolated: a thread that waits for the views of this panel must not begin another one, which would be in memory at full size, too.
        tbb::this_task_arena::isolate([&] {
            draw_panel(job, piece.panel, folder, settings);
            if (--job.panels_left == 0) finish_figure(job, folder, settings);
        });
        const std::lock_guard lock(reporting);
        if (progress) progress(static_cast<double>(++drawn) / static_cast<double>(pieces.size()));
    });
    report::DrawnFigures all;
    for (const FigureJob& job : figures) all.emplace(job.request->id, job.drawn);
    return all;
}

}   // namespace meshfolio::output
