#include "run/one_mesh/mesh_pictures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "geometry/operators/vertex_areas.h"
#include "mesh/io/polygon_list.h"
#include "output/draw/figure_request.h"
#include "output/draw/surface_of.h"
#include "run/arguments.h"
#include "scene/hero.h"

namespace meshfolio::run {

namespace {

constexpr double densest_lines = 4, densest_edges = 3;       // distance of isolines, length of edges [pixels]
constexpr int largest_cell = 2048;                           // of a labelled sheet, which is to be looked at, not measured
constexpr double narrowest_range = 1 / largest_coordinate;   // that a colour bar can print

output::Panel panel_of(const PreparedMesh& prepared, const Field& field) {
    return {"", "", std::shared_ptr<const TriangleMesh>(std::shared_ptr<void>(), &prepared.mesh), field.values};
}

std::string counts_of(const PreparedMesh& prepared) {
    return readable_count(prepared.preflight.vertices_in_use) + " vertices, " + readable_count(prepared.preflight.triangles) + " triangles";
}

/// Returns the pixels per unit of length in views along an axis, which share a frame.
double scale_of(const PreparedMesh& prepared, const render::DrawOptions& draw) {
    return draw.frame ? draw.frame->pixels_per_unit
                      : render::frame_of(output::bounds_of(prepared.mesh), draw.width, draw.height, draw.fill).pixels_per_unit;
}

/// Leaves out edges shorter than 3 pixels on average, which would cover the mesh. Returns words about that for the subtitle, or "".
std::string leave_out_dense_edges(const PreparedMesh& prepared, render::DrawOptions& draw) {
    const TriangleMesh& mesh = prepared.mesh;
    if (!draw.edges || mesh.face_count() == 0) return "";
    double sum = 0;
    for (const auto& t : mesh.F.rowwise())
        for (int k = 0; k < 3; ++k) sum += (mesh.X.row(t[k]) - mesh.X.row(t[(k + 1) % 3])).norm();
    const double length = sum / (3 * mesh.face_count()) * scale_of(prepared, draw);   // [pixels]
    if (length >= densest_edges) return "";
    draw.edges = false;
    return "; edges left out, as they would be " + readable(length, 2) + " pixels long";
}

/// @throws UsageError if isolines would hide the colours between them
void refuse_dense_isolines(const PreparedMesh& prepared, const Field& field, const render::DrawOptions& draw) {
    if (draw.isoline_spacing <= 0 || field.values.size() == 0) return;
    const TriangleMesh& mesh = prepared.mesh;
    std::vector<double> slopes;
    for (const auto& t : mesh.F.rowwise()) {
        const Vector3 a = mesh.X.row(t[0]), b = mesh.X.row(t[1]), c = mesh.X.row(t[2]);
        const Vector3 turned = field.values[t[0]] * (c - b) + field.values[t[1]] * (a - c) + field.values[t[2]] * (b - a);
        if (const double slope = turned.norm() / (b - a).cross(c - a).norm(); std::isfinite(slope)) slopes.push_back(slope);
    }
    if (slopes.empty()) return;
    const auto median = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
    std::ranges::nth_element(slopes, median);
    const double apart = draw.isoline_spacing * scale_of(prepared, draw) / *median;   // [pixels]
    if (apart < densest_lines)
        throw UsageError(
            "isolines every " + plain_text(draw.isoline_spacing) + " would be " + readable(apart, 2) + " pixels apart",
            "take " + plain_text(rounded_up(draw.isoline_spacing * densest_lines / apart, 1)) + " or more, or larger pictures");
}

/// Returns "rms 0.12 1/length": the root mean square of the field over the area.
std::string rms_of(const PreparedMesh& prepared, const Field& field) {
    const Vector areas = vertex_areas(prepared.mesh, AreaForm::barycentric);
    double sum = 0, area = 0;
    for (int i = 0; i < field.values.size(); ++i)
        if (std::isfinite(field.values[i])) sum += areas[i] * field.values[i] * field.values[i], area += areas[i];
    return "rms " + readable(std::sqrt(sum / area)) + (field.unit.empty() ? "" : " " + field.unit);
}

/// Returns a sheet without pictures, and the range of its colours.
MeshPictures sheet_for(const PictureRequest& request, const std::vector<output::Panel>& panels, const Field& field) {
    MeshPictures drawn;
    render::ContactSheet& sheet = drawn.sheet;
    sheet.background = request.draw.background;
    sheet.title = request.title;
    sheet.em = request.em;
    if (std::max(request.draw.width, request.draw.height) > largest_cell) sheet.cell = largest_cell;
    if (field.values.size() == 0) return drawn;
    const std::string colormap = !request.colormap.empty() ? request.colormap : field.is_signed ? "diverging" : "viridis";
    drawn.range = output::robust_range(panels, colormap, field.quantity, field.unit, field.floor);
    if (request.range) {
        std::tie(drawn.range->low, drawn.range->high) = *request.range;
        output::enter_clipped(*drawn.range, output::finite_values(panels));
    }
    const bool has_undefined = std::ranges::any_of(panels, [](const output::Panel& panel) { return panel.values.array().isNaN().any(); });
    sheet.color_bar = output::color_bar_of(*drawn.range, has_undefined, request.draw);
    return drawn;
}

/// Draws one mesh in the colours of the sheet.
std::vector<render::Image> pictures_of(const PreparedMesh& prepared, const Field& field, const MeshPictures& sheet,
                                       render::DrawOptions draw, std::span<const render::View> views) {
    if (sheet.range) draw.range = output::value_range(*sheet.range);
    const Vector3 &low = prepared.preflight.box_low, &high = prepared.preflight.box_high;
    if (!draw.frame && std::ranges::all_of(views, &render::View::is_along_axis))   // as draw_views would do, but faster
        draw.frame = render::frame_of({{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}}, draw.width, draw.height, draw.fill);
    return output::drawn_views(output::surface_of(prepared.mesh, sheet.range ? &field.values : nullptr), views, draw);
}

/// Replaces each view "hero" by the direction that shows this mesh best.
std::vector<render::View> with_hero_direction(std::vector<render::View> views, const TriangleMesh& mesh) {
    for (render::View& view : views)
        if (!view.is_along_axis()) view = render::hero_view(output::surface_of(mesh));
    return views;
}

TriangleMesh both_meshes(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both{Positions(a.X.rows() + b.X.rows(), 3), Faces(a.F.rows() + b.F.rows(), 3)};
    both.X << a.X, b.X;
    both.F << a.F, b.F.array() + a.vertex_count();
    return both;
}

/// Returns the frame of a picture of the mesh alone.
render::Frame frame_of(const TriangleMesh& mesh, const render::View& view, const render::DrawOptions& draw) {
    if (view.is_along_axis()) return render::frame_of(output::bounds_of(mesh), draw.width, draw.height, draw.fill);
    const render::Surface surface = output::surface_of(mesh);
    return render::frame_of(surface.positions, surface.triangles, view, draw.width, draw.height, draw.fill);
}

/// Returns the columns and rows of a bare sheet.
std::pair<int, int> bare_grid(std::size_t pictures) {
    const int count = static_cast<int>(pictures), columns = std::min(3, count);
    return {columns, (count + columns - 1) / columns};
}

}   // namespace

std::vector<render::View> views_named(const std::string& names) {
    std::vector<std::string> known{"hero"};
    for (const render::View& view : render::six_views) known.emplace_back(view.name);
    std::vector<render::View> views;
    for (const std::string& name : split(names, ',')) {
        if (!contains(known, name))
            throw UsageError("unknown view " + in_quotes(name), suggestion(name, known) + "known are " + meshfolio::joined(known, ", "));
        views.push_back(render::view_named(name));
    }
    if (views.empty()) views.assign(render::six_views.begin(), render::six_views.end());
    return views;
}

std::pair<double, double> value_limits(double low, double high, const std::string& name) {
    if (!(low < high)) throw UsageError(name + " is not lo,hi with lo < hi", "write two numbers such as -1,1");
    if (std::max(std::abs(low), std::abs(high)) > largest_coordinate || high - low < narrowest_range)
        throw UsageError(name + " is beyond 1e100 or narrower than 1e-100", "scale the values");
    return {low, high};
}

MeshPictures draw_pictures(const PreparedMesh& prepared, const Field& field, const PictureRequest& request) {
    MeshPictures drawn = sheet_for(request, {panel_of(prepared, field)}, field);
    refuse_dense_isolines(prepared, field, request.draw);
    render::DrawOptions draw = request.draw;
    drawn.sheet.subtitle = counts_of(prepared) + leave_out_dense_edges(prepared, draw);
    drawn.sheet.pictures = pictures_of(prepared, field, drawn, draw, with_hero_direction(request.views, prepared.mesh));
    for (const render::View& view : request.views) drawn.sheet.view_names.emplace_back(view.name);
    return drawn;
}

MeshPictures draw_pair(const PairedMesh& left, const PairedMesh& right, const PictureRequest& request) {
    Field both{.values = left.field.values, .quantity = left.field.quantity, .unit = left.field.unit};
    both.is_signed = left.field.is_signed || right.field.is_signed;
    both.floor = std::max(left.field.floor, right.field.floor);
    MeshPictures drawn = sheet_for(request, {panel_of(left.prepared, left.field), panel_of(right.prepared, right.field)}, both);
    drawn.sheet.columns = request.views.size() > 1 ? 4 : 2;
    for (const auto& [letter, one] : {std::pair{"A", &left}, std::pair{"B", &right}}) {
        refuse_dense_isolines(one->prepared, one->field, request.draw);
        drawn.sheet.heads.push_back(letter + (": " + std::filesystem::path(one->prepared.file).filename().string()));
        drawn.sheet.subheads.push_back(one->field.values.size() == 0 ? counts_of(one->prepared) : rms_of(one->prepared, one->field));
    }
    const TriangleMesh whole = both_meshes(left.prepared.mesh, right.prepared.mesh);
    for (const render::View& view : with_hero_direction(request.views, left.prepared.mesh)) {
        render::DrawOptions draw = request.draw;
        draw.frame = frame_of(whole, view, draw);
        leave_out_dense_edges(left.prepared, draw);
        for (const PairedMesh* one : {&left, &right}) {
            drawn.sheet.pictures.push_back(pictures_of(one->prepared, one->field, drawn, draw, std::span(&view, 1)).front());
            drawn.sheet.view_names.emplace_back(view.name);
        }
    }
    return drawn;
}

render::Image composed(const render::ContactSheet& sheet, bool bare) {
    if (!bare) return render::compose(sheet);
    const auto [columns, rows] = bare_grid(sheet.pictures.size());
    const int width = sheet.pictures.front().width, height = sheet.pictures.front().height;
    render::Image composed(columns * width, rows * height);
    for (int i = 0; const render::Image& picture : sheet.pictures) {
        render::paste(composed, picture, i % columns * width, i / columns * height);
        ++i;
    }
    return composed;
}

std::int64_t bare_sheet_pixels(std::size_t views, const render::DrawOptions& draw) {
    const auto [columns, rows] = bare_grid(views);
    return std::int64_t{columns} * draw.width * rows * draw.height;
}

}   // namespace meshfolio::run
