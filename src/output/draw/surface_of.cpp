#include "output/draw/surface_of.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "output/draw/figure_request.h"

namespace meshfolio::output {

// Rows of Positions and Faces have the layout of the renderer's vectors.
static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && alignof(glm::dvec3) == alignof(double));
static_assert(sizeof(glm::ivec3) == 3 * sizeof(int) && alignof(glm::ivec3) == alignof(int));

std::vector<render::Image> drawn_views(const render::Surface& surface, std::span<const render::View> views,
                                       const render::DrawOptions& options) try {
    return render::draw_views(surface, views, options);
} catch (const render::TooMuchOverdraw& error) {
    throw MeshError(std::string("cannot be drawn: ") + error.what() + " (" + std::to_string(surface.triangles.size()) + " in all)",
                    "take smaller pictures (--size), or a mesh without repeated triangles");
}

render::Surface surface_of(const TriangleMesh& mesh, const Vector* values) {
    render::Surface surface;
    surface.positions = {reinterpret_cast<const glm::dvec3*>(mesh.X.data()), static_cast<std::size_t>(mesh.X.rows())};
    surface.triangles = {reinterpret_cast<const glm::ivec3*>(mesh.F.data()), static_cast<std::size_t>(mesh.F.rows())};
    if (values != nullptr) surface.values = {values->data(), static_cast<std::size_t>(values->size())};
    return surface;
}

render::Bounds bounds_of(const TriangleMesh& mesh) {
    const render::Surface surface = surface_of(mesh);
    return render::bounds_of(surface.positions, surface.triangles);
}

bool fits_frame(const render::Bounds& bounds, const Positions& X) {
    const render::Frame frame = render::frame_of(bounds, 1, 1, render::DrawOptions{}.fill);   // a picture one pixel wide
    const Eigen::RowVector3d centre(frame.centre.x, frame.centre.y, frame.centre.z);
    return (frame.pixels_per_unit * (X.rowwise() - centre).array().abs() <= 0.5).all();
}

const render::Colormap& colormap_of(const ColorRange& range) {
    if (range.own_map) return *range.own_map;
    if (const render::Colormap* map = render::find_colormap(range.colormap)) return *map;
    std::vector<std::string> known;
    for (const render::Colormap& map : render::colormap_list()) known.emplace_back(map.name);
    throw UsageError("unknown colour map " + in_quotes(range.colormap),
                     suggestion(range.colormap, known) + "known are " + meshfolio::joined(known, ", "));
}

render::ValueRange value_range(const ColorRange& range) { return {&colormap_of(range), range.low, range.high, range.logarithmic}; }

std::vector<double> histogram_of(const std::vector<double>& values, const render::ValueRange& range) {
    if (!range.logarithmic) return histogram(values, range.low, range.high);
    std::vector<double> logarithms(values.size());
    std::ranges::transform(values, logarithms.begin(), [](double value) { return std::log(value); });
    return histogram(logarithms, std::log(range.low), std::log(range.high));
}

render::ColorBar color_bar_of(const ColorRange& range, bool has_undefined, const render::DrawOptions& drawn) {
    render::ColorBar bar;
    bar.range = value_range(range);
    bar.quantity = range.quantity;
    if (const double spacing = bar.isoline_spacing = drawn.isoline_spacing; spacing > 0) {
        const double first = std::ceil(range.low / spacing) * spacing + 0.0;   // never −0
        if (first <= range.high)
            bar.quantity += first + spacing > range.high ? ", a line at " + readable(first) : ", a line every " + readable(spacing);
    }
    bar.unit = range.unit;
    bar.clipped_below = range.clipped_below;
    bar.clipped_above = range.clipped_above;
    bar.has_undefined = has_undefined;
    bar.undefined_color = drawn.undefined_color;
    bar.histogram = histogram_of(range.sample, bar.range);
    return bar;
}

render::ColorBar small_bar_of(const ColorRange& range) { return color_bar_of(range, false, render::DrawOptions()); }

std::string hex_of(render::Rgba color) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t c : {color.r, color.g, color.b}) text += {digits[c >> 4], digits[c & 15]};
    return text;
}

report::Legend legend_of(const render::ColorBar& bar) {
    constexpr int colours = 48;
    report::Legend legend{bar.quantity,      bar.unit, bar.range.low, bar.range.high,       {}, bar.clipped_below,
                          bar.clipped_above, "",       bar.histogram, bar.range.logarithmic};
    for (int i = 0; i < colours; ++i) legend.colours.push_back(hex_of(render::color_at(*bar.range.colormap, (i + 0.5) / colours)));
    if (bar.has_undefined) legend.undefined = hex_of(bar.undefined_color);
    return legend;
}

}   // namespace meshfolio::output
