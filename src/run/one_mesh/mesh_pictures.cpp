#include "run/one_mesh/mesh_pictures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "mesh/io/polygon_list.h"
#include "output/draw/figure_request.h"
#include "output/draw/surface_of.h"
#include "scene/hero.h"

namespace meshfolio::run {

namespace {

constexpr double densest_lines = 4, densest_edges = 3;   // distance of isolines, length of edges [pixels]
constexpr char camera_name[] = "camera";
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

/// Draws one mesh in the colours of a range.
std::vector<render::Image> pictures_of(const PreparedMesh& prepared, const Field& field, const std::optional<output::ColorRange>& range,
                                       render::DrawOptions draw, std::span<const render::View> views) {
    if (range) draw.range = output::value_range(*range);
    const Vector3 &low = prepared.preflight.box_low, &high = prepared.preflight.box_high;
    if (std::ranges::all_of(views, &render::View::is_along_axis))   // as draw_views would do, but faster
        draw.frame = render::frame_of({{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}}, draw.width, draw.height, draw.fill);
    return output::drawn_views(output::surface_of(prepared.mesh, range ? &field.values : nullptr), views, draw);
}

/// Replaces each view "hero" by the direction that shows this mesh best.
std::vector<render::View> with_hero_direction(std::vector<render::View> views, const TriangleMesh& mesh, const render::Sight& sight) {
    for (render::View& view : views)
        if (view.name == render::three_quarter_view().name) view = render::hero_view(output::surface_of(mesh), sight.up);
    return views;
}

/// Returns the name of a view for people.
std::string label_of(const render::View& view, const render::Sight& sight) {
    if (view.name != camera_name) return std::string(view.name);
    const auto [azimuth, elevation, roll] = *sight.camera;
    return "azimuth " + plain_text(azimuth) + "°, elevation " + plain_text(elevation) + "°" +
           (roll == 0 ? "" : ", roll " + plain_text(roll) + "°");
}

/// Returns the columns and rows of a bare sheet.
std::pair<int, int> bare_grid(std::size_t pictures) {
    const int count = static_cast<int>(pictures), columns = std::min(3, count);
    return {columns, (count + columns - 1) / columns};
}

}   // namespace

std::vector<render::View> views_named(const std::string& names, const render::Sight& sight) {
    std::vector<std::string> known{"hero"};
    if (sight.camera) known.emplace_back(camera_name);
    for (const render::View& view : render::six_views) known.emplace_back(view.name);
    std::vector<render::View> views;
    for (const std::string& name : split(names.empty() && sight.camera ? camera_name : names, ',')) {
        if (!contains(known, name))
            throw UsageError("unknown view " + in_quotes(name), suggestion(name, known) + "known are " + meshfolio::joined(known, ", "));
        const render::Up up = sight.up.value_or(render::Up::y);
        views.push_back(name == camera_name ? render::view_from(*sight.camera, up) : render::view_named(name, up));
    }
    for (const render::View& view : render::six_views)
        if (names.empty() && !sight.camera) views.push_back(render::view_named(std::string(view.name), sight.up.value_or(render::Up::y)));
    return views;
}

std::pair<double, double> value_limits(const std::string& text) {
    const std::vector<std::string> ends = split(text, ',');
    const auto low = parse_number(ends.empty() ? "" : ends.front()), high = parse_number(ends.size() == 2 ? ends.back() : "");
    if (!low || !high || !(*low < *high))
        throw UsageError("--range " + in_quotes(text) + " is not lo,hi with lo < hi", "write two numbers such as -1,1");
    if (std::max(std::abs(*low), std::abs(*high)) > largest_coordinate || *high - *low < narrowest_range)
        throw UsageError("--range " + in_quotes(text) + " is beyond 1e100 or narrower than 1e-100", "scale the values");
    return {*low, *high};
}

ColorChoice color_choice(const PictureWords& words) {
    ColorChoice colors = words.colormap.empty() ? ColorChoice() : colormap_choice(words.colormap);
    if (!words.range.empty()) colors.range = value_limits(words.range);
    return colors;
}

render::Rgba background_of(const PictureWords& words) {
    const std::string& text = words.background;
    if (text.empty() || text == "white") return {255, 255, 255, 255};
    if (text == "none") return {255, 255, 255, 0};
    unsigned color = 0;
    const char* end = text.data() + text.size();
    if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, end, color, 16).ptr != end)
        throw UsageError("--background " + in_quotes(text) + " is not a colour", "write white, none or #rrggbb, such as #fdf6e3");
    return {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8), static_cast<std::uint8_t>(color), 255};
}

PictureRequest picture_request(const PictureWords& words) {
    PictureRequest request{.views = {}, .colors = color_choice(words), .sight = sight_of(words.sight), .title = words.title};
    request.views = views_named(words.views, request.sight);
    const std::vector<std::string> sides = split(words.size, 'x');   // "1024" or "800x600"
    const auto width = parse_integer(sides.empty() ? "" : sides.front()),
               height = parse_integer(sides.empty() || sides.size() > 2 ? "" : sides.back());
    const auto fits = [](const std::optional<long long>& side) { return side && *side >= 1 && *side <= largest_side; };
    if (!fits(width) || !fits(height))
        throw UsageError("--size " + in_quotes(words.size) + " is not N or WxH", "both between 1 and " + std::to_string(largest_side));
    render::DrawOptions& draw = request.draw;
    draw.width = static_cast<int>(*width);
    draw.height = static_cast<int>(*height);
    draw.edges = words.edges;
    if (!words.isolines.empty()) draw.isoline_spacing = number_above_zero("--isolines", words.isolines);
    draw.background = background_of(words);
    draw.face_colors_from_id = words.field == "id";
    return request;
}

std::optional<output::ColorRange> color_range(const std::vector<output::Panel>& panels, const Field& field, const ColorChoice& colors) {
    if (field.values.size() == 0) return {};
    const std::string& colormap = colors.name.empty() ? field.colormap : colors.name;
    output::ColorRange range =
        output::robust_range(panels, colormap, field.quantity, field.unit, field.floor, output::usual_clip, colors.own_map);
    if (colors.range) {
        std::tie(range.low, range.high) = *colors.range;
        output::enter_clipped(range, output::finite_values(panels));
    }
    return range;
}

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

MeshPictures draw_pictures(const PreparedMesh& prepared, const Field& field, const PictureRequest& request) {
    render::DrawOptions draw = request.draw;
    draw.fill *= request.sight.zoom;
    refuse_dense_isolines(prepared, field, draw);
    const std::vector<output::Panel> panels{panel_of(prepared, field)};
    MeshPictures drawn{color_range(panels, field, request.colors), {}};
    render::ContactSheet& sheet = drawn.sheet;
    sheet.background = draw.background;
    sheet.title = request.title;
    sheet.up = request.sight.up.value_or(render::Up::y);
    if (std::max(draw.width, draw.height) > largest_cell) sheet.cell = largest_cell;
    if (drawn.range) sheet.color_bar = output::color_bar_of(*drawn.range, field.values.array().isNaN().any(), draw);
    sheet.subtitle = counts_of(prepared) + leave_out_dense_edges(prepared, draw);
    sheet.pictures = pictures_of(prepared, field, drawn.range, draw, with_hero_direction(request.views, prepared.mesh, request.sight));
    for (const render::View& view : request.views) sheet.view_names.push_back(label_of(view, request.sight));
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
