#include "run/one_mesh/mesh_pictures.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "base/errors.h"
#include "mesh/io/polygon_list.h"
#include "output/draw/surface_of.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

constexpr int largest_cell = 2048;                           // of a labelled sheet: to be looked at, not measured
constexpr double narrowest_range = 1 / largest_coordinate;   // where numbers on a colour bar end

output::ColorRange color_range(const PictureRequest& request, const PreparedMesh& prepared, const Field& field) {
    const std::string colormap = !request.colormap.empty() ? request.colormap : field.is_signed ? "diverging" : "viridis";
    const output::Panel panel{"", "", std::shared_ptr<const TriangleMesh>(std::shared_ptr<void>(), &prepared.mesh), field.values};
    output::ColorRange range = output::robust_range({panel}, colormap, field.quantity, field.unit, field.floor);
    if (!request.range) return range;
    std::tie(range.low, range.high) = *request.range;
    const auto share = [&](auto outside) {
        const double finite = static_cast<double>(field.values.array().isFinite().count());
        return finite > 0 ? static_cast<double>(std::count_if(field.values.begin(), field.values.end(), outside)) / finite : 0;
    };
    range.clipped_below = share([&](double v) { return v < range.low; });
    range.clipped_above = share([&](double v) { return v > range.high; });
    return range;
}

/// Of a sheet without anything added: three pictures in a row.
struct BareGrid {
    explicit BareGrid(std::size_t pictures)
        : columns(std::min(3, static_cast<int>(pictures))), rows((static_cast<int>(pictures) + columns - 1) / columns) {}
    int columns, rows;
};

render::Image bare_sheet(const std::vector<render::Image>& pictures) {
    const BareGrid grid(pictures.size());
    render::Image sheet(grid.columns * pictures.front().width, grid.rows * pictures.front().height);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        render::paste(sheet, pictures[i], static_cast<int>(i) % grid.columns * pictures[i].width,
                      static_cast<int>(i) / grid.columns * pictures[i].height);
    }
    return sheet;
}

}   // namespace

std::vector<render::View> views_named(const std::string& names) {
    std::vector<render::View> views;
    for (const std::string& name : split(names, ',')) {
        try {
            views.push_back(render::view_named(name));
        } catch (const std::invalid_argument& error) {
            throw UsageError(error.what());
        }
    }
    if (views.empty()) views.assign(render::six_views.begin(), render::six_views.end());
    return views;
}

std::pair<double, double> value_limits(double low, double high, const std::string& told) {
    if (!(low < high)) throw UsageError(told + " is not lo,hi with lo < hi");
    if (std::max(std::abs(low), std::abs(high)) > largest_coordinate || high - low < narrowest_range)
        throw UsageError(told + " is beyond 1e100 or narrower than 1e-100", "scale the values");
    return {low, high};
}

MeshPictures draw_pictures(const PreparedMesh& prepared, const Field& field, const PictureRequest& request) {
    MeshPictures drawn;
    render::DrawOptions draw = request.draw;
    if (field.values.size() > 0) {
        drawn.range = color_range(request, prepared, field);
        draw.range = output::value_range(*drawn.range);
    }
    render::ContactSheet& sheet = drawn.sheet;
    sheet.pictures = render::draw_views(output::surface_of(prepared.mesh, drawn.range ? &field.values : nullptr), request.views, draw);
    sheet.background = draw.background;
    sheet.title = request.title;
    sheet.subtitle =
        std::to_string(prepared.preflight.vertices_in_use) + " vertices, " + std::to_string(prepared.preflight.triangles) + " triangles";
    for (const render::View& view : request.views) sheet.view_names.emplace_back(view.name);
    if (std::max(draw.width, draw.height) > largest_cell) sheet.cell = largest_cell;
    if (drawn.range) sheet.color_bar = output::color_bar_of(*drawn.range, field.values.array().isNaN().any(), draw.undefined_color);
    return drawn;
}

render::Image composed(const render::ContactSheet& sheet, bool bare) { return bare ? bare_sheet(sheet.pictures) : render::compose(sheet); }

std::int64_t bare_sheet_pixels(std::size_t views, const render::DrawOptions& draw) {
    const BareGrid grid(views);
    return std::int64_t{grid.columns} * draw.width * grid.rows * draw.height;
}

}   // namespace meshfolio::run
