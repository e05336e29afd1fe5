/// @file
/// The pictures of the Python module: NumPy arrays, or figures in files.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "base/number_text.h"
#include "output/publish/file_group.h"
#include "png/png.h"
#include "python/interruptible.h"
#include "python/mesh_arrays.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/one_mesh/colormap_choice.h"
#include "run/one_mesh/fields.h"
#include "run/one_mesh/figure.h"
#include "run/one_mesh/mesh_pictures.h"
#include "sheet/drawing.h"

namespace meshfolio::python {

/// Returns (N, N) for N, or (width, height). @throws UsageError unless both are whole numbers from 1 to run::largest_side
inline std::pair<int, int> picture_size(const py::object& size) {
    std::pair<int, int> sides;
    try {
        sides = PyIndex_Check(size.ptr()) != 0 ? std::pair{size.cast<int>(), size.cast<int>()} : size.cast<std::pair<int, int>>();
    } catch (const py::cast_error&) {   // not numbers: refused below
    }
    const auto [width, height] = sides;
    if (std::min(width, height) < 1 || std::max(width, height) > run::largest_side)
        throw UsageError("size is not N or (width, height)", "both between 1 and " + std::to_string(run::largest_side));
    return sides;
}

inline py::array array_of(render::Image picture) {
    const auto kept = std::make_shared<const render::Image>(std::move(picture));
    static_assert(sizeof(render::Rgba) == 4);
    return array_over(reinterpret_cast<const std::uint8_t*>(kept->pixels.data()), {kept->height, kept->width, 4}, kept);
}

inline py::bytes png_of(const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>& array) {
    if (array.ndim() != 3 || array.shape(2) != 4) throw UsageError("a picture is height x width x 4", "RGBA, 8 bits each");
    render::Image picture(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
    std::copy_n(array.data(), array.size(), reinterpret_cast<std::uint8_t*>(picture.pixels.data()));
    return render::encode_png(picture);
}

inline run::ColorChoice colors_of(const std::string& colormap, const std::optional<std::pair<double, double>>& range) {
    run::ColorChoice colors;
    if (!colormap.empty()) {
        run::ColormapChoice choice = run::colormap_choice(colormap);
        if (!choice.warning.empty()) warn(choice.warning);
        colors = {std::move(choice.name), std::move(choice.own_map), {}};
    }
    if (range)
        colors.range =
            run::value_limits(range->first, range->second, "range (" + plain_text(range->first) + ", " + plain_text(range->second) + ")");
    return colors;
}

using SightWords = std::tuple<std::string, std::string, std::string>;   // camera, up, zoom; empty: not given

inline render::Sight sight_of(const SightWords& words) {
    return run::sight_of({std::get<0>(words), std::get<1>(words), std::get<2>(words)});
}

inline py::array draw(const Mesh& mesh, const std::string& field_name, const py::object& values, const std::string& label,
                      const std::string& views, const SightWords& sight, const py::object& size, const std::string& colormap,
                      const std::optional<std::pair<double, double>>& range, double isolines, bool edges, bool transparent) {
    const bool own = !values.is_none();
    if (!own) run::require_choice("field", field_name, run::field_names());
    run::PictureRequest request{.views = run::views_named(views, sight_of(sight)),
                                .colors = colors_of(colormap, range),
                                .sight = sight_of(sight),
                                .title = std::filesystem::path(mesh.prepared->file).filename().string()};
    std::tie(request.draw.width, request.draw.height) = picture_size(size);
    request.draw.isoline_spacing = run::number_not_negative("isolines", plain_text(isolines));
    request.draw.edges = edges;
    request.draw.face_colors_from_id = !own && field_name == "id";
    if (transparent) request.draw.background = {255, 255, 255, 0};
    std::optional<run::Field> given;
    if (own) given = run::field_of_values(values_of(values, mesh.triangles().X.rows()), label);
    return array_of(interruptible([=, of = mesh.prepared](const Stop& stop) {
        const run::Field field = given ? *given : run::field_of(*of, field_name);
        stop.check();
        run::MeshPictures drawn = run::draw_pictures(*of, field, request);
        stop.check();
        return drawn.sheet.pictures.size() == 1 ? std::move(drawn.sheet.pictures.front())
                                                : run::composed(drawn.sheet, request.draw.face_colors_from_id);
    }));
}

/// Returns the style that the keywords of figure() ask for; they are named like the options of `render`.
inline run::FigureStyle style_of(const py::dict& keywords) {
    const auto text = [&](const char* key) { return std::string(py::str(keywords[key])); };
    const auto is_given = [&](const char* key) { return !keywords[key].is_none(); };
    const auto background = keywords["background"].cast<std::array<std::uint8_t, 4>>();
    run::require_choice("fit", text("fit"), {"each", "common"});
    run::FigureStyle style{.views = run::split(text("views"), ','),
                           .sight = sight_of(keywords["sight"].cast<SightWords>()),
                           .common_fit = text("fit") == "common",
                           .title = text("title"),
                           .bars = keywords["bar"].cast<bool>(),
                           .background = {background[0], background[1], background[2], background[3]},
                           .colors = colors_of(text("colormap"), keywords["range"].cast<std::optional<std::pair<double, double>>>()),
                           .isoline_spacing = run::number_not_negative("isolines", text("isolines")),
                           .edges = keywords["edges"].cast<bool>()};
    run::views_named(text("views"), style.sight);   // throws
    if (is_given("columns")) style.columns = static_cast<int>(run::integer_between("columns", text("columns"), 1, run::most_columns));
    if (is_given("width_mm")) style.width = run::number_between("width_mm", text("width_mm"), run::smallest_width, run::largest_width);
    if (is_given("dpi")) style.resolution = run::number_between("dpi", text("dpi"), run::least_resolution, run::largest_resolution);
    return style;
}

/// @param values  for each label an array a mesh @param path  the file to write; None: a picture is returned
inline py::object figure(const std::vector<Mesh>& meshes, const std::vector<std::string>& labels, const std::vector<std::string>& fields,
                         const std::vector<std::pair<std::string, std::vector<py::object>>>& values, const py::object& path,
                         const py::dict& keywords) {
    std::vector<std::string> known = run::field_names();
    known.emplace_back("distance");
    for (const std::string& name : fields) run::require_choice("fields", name, known);
    const std::string file = path.is_none() ? "" : path.cast<std::filesystem::path>().string();
    run::check_output("path", file, {".pdf", ".svg", ".png"});
    const run::FigureStyle style = style_of(keywords);
    std::vector<PreparedMesh> prepared;
    std::vector<std::vector<run::Field>> given(meshes.size());
    for (const Mesh& mesh : meshes) prepared.push_back(*mesh.prepared);
    for (const auto& [label, arrays] : values)
        for (std::size_t i = 0; i < meshes.size(); ++i)
            given[i].push_back(run::field_of_values(values_of(arrays[i], meshes[i].triangles().X.rows()), label));
    auto [picture, bytes] = interruptible([=](const Stop& stop) {
        std::vector<run::FigureMesh> drawn;
        const std::vector<std::string> names = labels.empty() ? run::labels_of(prepared) : labels;
        for (std::size_t i = 0; i < prepared.size(); ++i) drawn.push_back({names[i], prepared[i], {}});
        for (const std::string& name : fields) {
            std::vector<run::Field> computed = run::fields_of(prepared, name);
            for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].fields.push_back(std::move(computed[i]));
            stop.check();
        }
        for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].fields.insert(drawn[i].fields.end(), given[i].begin(), given[i].end());
        const render::Drawing drawing = run::figure_of(drawn, style);
        stop.check();
        if (file.empty()) return std::pair{render::painted(drawing), std::string()};
        const std::string title = style.title.empty() ? joined(names, ", ") : style.title;
        return std::pair{render::Image(), run::encode_figure(drawing, style.resolution, title, lower_case_ending(file))};
    });
    if (file.empty()) return array_of(std::move(picture));
    const py::gil_scoped_release released;   // cannot be interrupted
    output::replace_file(file, bytes);
    return py::none();
}

inline void add_pictures(py::module_& m) {
    m.def("draw", &draw);
    m.def("figure", &figure);
    m.def("encode_png", &png_of);
    m.def("save_png", [](const py::object& picture, const std::string& path) {
        run::check_output("path", path, {".png"});
        output::replace_file(path, png_of(picture).cast<std::string>());
    });
}

}   // namespace meshfolio::python
