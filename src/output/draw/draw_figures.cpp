#include "output/draw/draw_figures.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/parallel_tasks.h"
#include "draw_mesh.h"
#include "output/draw/arrangement.h"
#include "output/draw/draw_models.h"
#include "output/draw/figure_request.h"
#include "output/draw/finished_picture.h"
#include "output/draw/framing.h"
#include "output/draw/surface_of.h"
#include "output/publish/folder_system.h"
#include "png/png.h"

namespace meshfolio::output {

namespace {

/// A figure while its panels are being drawn.
struct FigureJob {
    const FigureRequest* request = nullptr;
    std::vector<PictureFrame> three_quarters;   // a panel
    std::optional<SixFrames> six;
    std::vector<PanelPictures> pictures;   // a panel
    std::atomic<int> panels_left = 0;
    report::DrawnFigure drawn;
};

/// Sizes of pictures in sheets [pixels]: twice to three times what they take on paper and about what they take on the page.
constexpr int leading = 600, leading_a_block = 420, in_a_strip = 400, line_of_pictures = 1280, smallest_in_a_line = 192, small = 216,
              small_in_a_block = 151;

bool has_six_views(const FigureRequest& request) { return request.layout == Layout::six_views; }

double scale_of(const DrawSettings& settings) { return std::min({1.0, settings.width / 800.0, settings.height / 800.0}); }
int scaled(int side, const DrawSettings& settings) { return std::max(8, static_cast<int>(std::lround(side * scale_of(settings)))); }

int three_quarter_side(const FigureRequest& request) {
    if (is_gallery(request)) return small;
    if (request.panels.size() == 1) return leading;
    if (has_six_views(request)) return leading_a_block;
    if (request.panels.size() > 8) return smallest_in_a_line;   // line below line
    return std::clamp(line_of_pictures / panels_in_a_line(request), smallest_in_a_line, in_a_strip);
}

/// Requires a mesh in every panel, except in the cells of a matrix.
void require_meshes(const FigureRequest& request) {
    const std::size_t panels = request.panels.size(), columns = request.columns.size(), rows = request.rows.size();
    const auto refuse = [&](const char* why) { throw std::logic_error("figure " + request.id + " " + why); };
    const auto has_mesh = [](const Panel& panel) { return panel.mesh != nullptr; };
    const bool is_matrix = columns > 0 || rows > 0;
    if (std::none_of(request.panels.begin(), request.panels.end(), has_mesh)) refuse("has no panel");
    if (!is_matrix && !std::all_of(request.panels.begin(), request.panels.end(), has_mesh)) refuse("has a panel without a mesh");
    if (is_matrix && has_six_views(request)) refuse("has heads and six views");
    if ((columns > 0 && panels % columns != 0) || (rows > 0 && panels % rows != 0) || (columns > 0 && rows > 0 && panels != columns * rows))
        refuse("has another number of panels than its heads say");
    if (request.frame_panel >= static_cast<int>(panels) ||
        (request.frame_panel >= 0 && !has_mesh(request.panels[static_cast<std::size_t>(request.frame_panel)])))
        refuse("is framed on a panel it has not");
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
        for (const Panel& panel : request.panels)
            if (panel.mesh) require(panel.name);
        require_meshes(request);
    }
}

/// Triangles below which a shape cannot be seen without its edges.
constexpr Eigen::Index coarse_mesh = 3000;
bool shows_edges(const FigureRequest& request, const Panel& panel) {
    const bool plain = panel.values.size() == 0 || !request.range;
    const bool coarse = panel.mesh->face_count() < coarse_mesh;
    return request.edges || (coarse && (request.coarse_edges || (plain && !has_six_views(request))));
}

render::DrawOptions options_of(const FigureRequest& request, const Panel& panel) {
    render::DrawOptions options;
    options.edges = shows_edges(request, panel);
    options.isoline_spacing = request.isoline_spacing;
    options.marked_vertices = panel.marked_vertices;
    if (request.range) options.range = value_range(*request.range);
    return options;
}

render::Surface surface_in(const FigureRequest& request, const Panel& panel) {
    return surface_of(*panel.mesh, panel.values.size() > 0 && request.range ? &panel.values : nullptr);
}

std::string view_file(const Panel& panel, const render::View& view) {
    return "images/" + panel.name + "_" + std::string(view.name) + ".png";
}

bool has_view_files(const FigureRequest& request, const DrawSettings& settings) {
    return settings.view_files || (request.view_files && !settings.sheets_only);
}

bool has_undefined(const FigureRequest& request) {
    return std::any_of(request.panels.begin(), request.panels.end(), [](const Panel& panel) { return panel.values.array().isNaN().any(); });
}

/// Draws each view as a file in full size, labelled in a corner.
void draw_view_files(const FigureJob& job, std::size_t index, const std::filesystem::path& folder, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    const Panel& panel = request.panels[index];
    const render::View& hero = job.three_quarters[index].view;
    const std::vector<render::View> directions = has_six_views(request) ? views_in_reading_order() : std::vector{hero};
    render::DrawOptions options = options_of(request, panel);
    options.width = settings.width;
    options.height = settings.height;
    options.frame = full_frame(request, index, has_six_views(request) ? nullptr : &hero, options.width, options.height);
    std::vector<render::Image> views = drawn_views(surface_in(request, panel), directions, options);
    for_each_task(views.size(), [&](std::size_t i) {
        label_view(views[i], directions[i].name);
        write_file(folder / view_file(panel, directions[i]), render::encode_png(views[i]));
        views[i] = {};
    });
}

void draw_panel(FigureJob& job, std::size_t index, const std::filesystem::path& folder, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    const Panel& panel = request.panels[index];
    if (!panel.mesh) return;
    const render::Surface surface = surface_in(request, panel);
    render::DrawOptions options = options_of(request, panel);
    PanelPictures& pictures = job.pictures[index];

    const PictureFrame& large = job.three_quarters[index];
    const std::array hero{large.view};
    options.width = large.width;
    options.height = large.height;
    options.frame = large.frame;
    pictures = drawn_views(surface, hero, options);
    if (job.six) {
        const PictureFrame whole = job.six->covering_all();
        options.width = whole.width;
        options.height = whole.height;
        options.frame = job.six->frame;
        const std::vector<render::View> directions = views_in_reading_order();
        const std::vector<render::Image> views = drawn_views(surface, directions, options);
        for (std::size_t i = 0; i < views.size(); ++i) {
            const PictureFrame& size = job.six->of(directions[i]);
            pictures.push_back(
                part_of(views[i], (views[i].width - size.width) / 2, (views[i].height - size.height) / 2, size.width, size.height));
        }
    }
    if (has_view_files(request, settings)) draw_view_files(job, index, folder, settings);
}

/// The bar of the sheet, and the legend of the page.
void set_legend(FigureJob& job, render::FigureSheet& sheet) {
    const ColorRange& range = *job.request->range;
    sheet.color_bar = color_bar_of(range, has_undefined(*job.request), render::DrawOptions().undefined_color);
    // of these panels: several figures may share a range
    if (!range.relative) sheet.color_bar->histogram = histogram_of(finite_values(job.request->panels), sheet.color_bar->range);
    job.drawn.legend = legend_of(*sheet.color_bar);
}

std::size_t pictures_of(const FigureRequest& request, std::size_t panel) {
    return !request.panels[panel].mesh ? 0 : has_six_views(request) ? 7 : 1;
}

/// Where the pictures are on the sheet.
void name_pictures(FigureJob& job, const render::FigureSheet& sheet, const render::ComposedFigure& composed, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    const std::vector<render::View> directions = views_in_reading_order();
    std::size_t next = 0;
    for (std::size_t p = 0; p < request.panels.size(); ++p) {
        report::DrawnPanel& panel = job.drawn.panels.emplace_back();
        panel.label = request.panels[p].label;
        for (std::size_t i = 0; i < pictures_of(request, p); ++i) {
            const render::FigureSheet::Picture& placed = sheet.pictures[next++];
            report::DrawnPicture& picture = panel.pictures.emplace_back();
            picture.view = i == 0 ? "" : std::string(directions[i - 1].name);
            picture.left = composed.left + placed.left;
            picture.top = composed.top + placed.top;
            picture.width = placed.image->width;
            picture.height = placed.image->height;
            const bool has_file = has_view_files(request, settings) && (i > 0 || !has_six_views(request));
            if (has_file) picture.file = view_file(request.panels[p], i == 0 ? render::three_quarter_view() : directions[i - 1]);
        }
    }
}

void finish_figure(FigureJob& job, const std::filesystem::path& folder, const DrawSettings& settings) {
    const FigureRequest& request = *job.request;
    job.drawn.columns = request.columns;
    job.drawn.rows = request.rows;
    job.drawn.in_a_line = panels_in_a_line(request);
    render::FigureSheet sheet = arranged(request, std::move(job.pictures), std::max(13.0, 21 * scale_of(settings)));
    sheet.title = request.title;
    sheet.subtitle = request.subtitle;
    if (request.range && !request.range->quantity.empty()) set_legend(job, sheet);
    const render::ComposedFigure composed = render::compose(sheet);
    name_pictures(job, sheet, composed, settings);
    job.drawn.sheet = "images/" + request.id + "_sheet.png";
    write_file(folder / job.drawn.sheet, render::encode_png(composed.image));
    cut_pictures(composed.image, job.drawn);
}

/// One panel of one figure: what is drawn in parallel.
struct Piece {
    std::size_t figure, panel;
};

void prepare(FigureJob& job, const FigureRequest& request, const DrawSettings& settings) {
    job.request = &request;
    job.three_quarters = three_quarter_frames(request, scaled(three_quarter_side(request), settings));
    if (has_six_views(request)) job.six = six_frames(request, scaled(request.panels.size() == 1 ? small : small_in_a_block, settings));
    job.pictures.resize(request.panels.size());
    job.panels_left = static_cast<int>(request.panels.size());
}

}   // namespace

report::DrawnFigures draw_figures(std::span<const FigureRequest> requests, const std::filesystem::path& folder,
                                  const DrawSettings& settings, const DrawEvents& events) {
    require_good_names(requests);
    make_folder(folder / "images");
    std::map<std::string, std::vector<report::DrawnModel>> models = write_models(requests, folder);

    std::vector<FigureJob> figures(requests.size());
    std::vector<Piece> pieces;
    for (std::size_t f = 0; f < requests.size(); ++f) {
        prepare(figures[f], requests[f], settings);
        figures[f].drawn.models = std::move(models[requests[f].id]);
        for (std::size_t p = 0; p < requests[f].panels.size(); ++p) pieces.push_back({f, p});
    }
    const auto is_early = [&](const FigureRequest& request) { return events.early.contains(request.id); };
    const auto others = std::stable_partition(pieces.begin(), pieces.end(), [&](Piece piece) { return is_early(requests[piece.figure]); });
    const auto drawn_figures = [&](bool all) {
        report::DrawnFigures drawn;
        for (const FigureJob& job : figures)
            if (all || is_early(*job.request)) drawn.emplace(job.request->id, job.drawn);
        return drawn;
    };
    std::atomic<std::ptrdiff_t> next = 0, early_left = others - pieces.begin();
    if (early_left == 0 && events.early_drawn) events.early_drawn({});
    std::mutex telling;
    std::size_t drawn = 0;
    // Handed out one by one, in their order.
    for_each_task(pieces.size(), [&](std::size_t) {
        const auto piece = pieces.begin() + next++;
        FigureJob& job = figures[piece->figure];
        // Isolated: a thread that waits for the views of this panel does not begin another one, so that at most one panel a thread is
        // in memory at full size.
        tbb::this_task_arena::isolate([&] {
            draw_panel(job, piece->panel, folder, settings);
            if (--job.panels_left == 0) finish_figure(job, folder, settings);
        });
        if (piece < others && --early_left == 0 && events.early_drawn) events.early_drawn(drawn_figures(false));
        const std::lock_guard lock(telling);
        if (events.progress) events.progress(static_cast<double>(++drawn) / static_cast<double>(pieces.size()));
    });
    return drawn_figures(true);
}

}   // namespace meshfolio::output
