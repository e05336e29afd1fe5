#include "run/one_mesh/difference_lines.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/base64.h"
#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "png/png.h"
#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "report/page/view_value.h"
#include "report/words.h"
#include "run/one_mesh/figure.h"

namespace meshfolio::run {

using namespace report::literals;

namespace {

constexpr report::Words words("compare");
constexpr int jpeg_quality = 85;

std::string name_of(const PreparedMesh& prepared) { return report::safe_text(std::filesystem::path(prepared.file).filename().string()); }

/// Draws both meshes from six sides as a JPEG. @param values  colour them by the distance to the other surface
std::string pictures(const PreparedMesh& a, const PreparedMesh& b, const SurfaceDistances& distances, const render::Sight& sight,
                     bool values) {
    const double diagonal = bounding_box(a.mesh).diagonal();
    const auto field = [&](const DistancesTo& to) { return values ? distance_field(to.of_vertices, diagonal) : Field(); };
    const std::vector<FigureMesh> meshes{{name_of(a), a, {field(distances.a_to_b)}}, {name_of(b), b, {field(distances.b_to_a)}}};
    FigureStyle style{.views = {"+x", "-x", "+y", "-y", "+z", "-z"}, .sight = sight, .common_fit = true, .columns = 4, .resolution = 210};
    if (sight.camera) style.views = {"camera"}, style.columns = 2;
    return render::encode_jpeg(render::painted(figure_of(meshes, style)), jpeg_quality);
}

/// Returns the percentages of the area per bin of distance, as steps.
report::Series steps(const std::string& name, const DistancesTo& distances, double high) {
    report::Series series{.name = name};
    const std::vector<double> shares = area_histogram(distances, high, distance_bins);
    for (std::size_t bin = 0; bin < shares.size(); ++bin) {
        for (const std::size_t end : {bin, bin + 1}) {
            series.x.push_back(high * static_cast<double>(end) / distance_bins);
            series.y.push_back(100 * shares[bin]);
        }
    }
    return series;
}

report::Plot histogram(const SurfaceDistances& distances) {
    const double high = distances.hausdorff.distance;
    report::Plot plot{.id = "distances", .alt = words.line("plot.alt", "largest"_a = readable(high))};
    plot.x_label = words.line("plot.x");
    plot.y_label = words.line("plot.y");
    for (const auto& [key, one] : {std::pair{"series.a_to_b", &distances.a_to_b}, std::pair{"series.b_to_a", &distances.b_to_a}})
        plot.series.push_back(steps(words.line(key), *one, high));
    return plot;
}

double value_of(const Difference& difference, std::string_view key) {
    return std::ranges::find(difference.lines, key, &DifferenceLine::key)->value;
}

/// Returns "+1.2 %" for a ratio of 1.012; "" for NaN.
std::string change_text(double ratio) {
    if (!std::isfinite(ratio)) return "";
    return (ratio > 1 ? "+" : "") + (ratio == 1 ? "0\u202f%" : readable_percent(ratio - 1, 2));
}

}   // namespace

std::string difference_page(const PreparedMesh& a, const PreparedMesh& b, const Difference& difference, const SurfaceDistances& distances,
                            const render::Sight& sight) {
    const double rms = value_of(difference, "rms"), max = value_of(difference, "max"), diagonal = value_of(difference, "box_diagonal");
    const std::string volume = change_text(value_of(difference, "volume_ratio")), area = change_text(value_of(difference, "area_ratio"));
    const bool differ = max > 1e-12 * diagonal;
    const auto line_view = [](const DifferenceLine& line) -> nlohmann::json {
        const std::string value = line.is_count ? readable_count(static_cast<long long>(line.value)) : readable(line.value, 6);
        return {{"title", line.title}, {"value", value}, {"meaning", line.meaning}};
    };
    nlohmann::json model{{"rms", readable(rms)},
                         {"rms_share", readable_percent(rms / diagonal, 2)},
                         {"largest", readable(max)},
                         {"largest_share", readable_percent(max / diagonal, 2)},
                         {"has_volume", !volume.empty()},
                         {"volume", volume},
                         {"area", area},
                         {"a", name_of(a)},
                         {"b", name_of(b)},
                         {"by_vertices", !difference.distances.has_value()},
                         {"lines", report::list_of(difference.lines, line_view)},
                         {"differ", differ},
                         {"same_triangles", difference.same_triangles},
                         {"picture", base64(pictures(a, b, distances, sight, differ))},
                         {"has_histogram", differ && distances.hausdorff.distance > 0 && distances.a_to_b.areas.sum() > 0 &&
                                               distances.b_to_a.areas.sum() > 0},
                         {"histogram", report::svg_of(histogram(distances))}};
    const report::Templates templates;
    report::add_design(model, templates, "compare");
    return report::render(templates, "compare.html", model, report::xml_escape);
}

}   // namespace meshfolio::run
