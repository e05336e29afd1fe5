/// @file
/// The pictures of the Python module: NumPy arrays, or figures in files.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/lower_case.h"
#include "output/publish/file_group.h"
#include "png/png.h"
#include "python/interruptible.h"
#include "python/mesh_arrays.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/one_mesh/fields.h"
#include "run/one_mesh/figure.h"
#include "run/one_mesh/mesh_pictures.h"
#include "sheet/drawing.h"

namespace meshfolio::python {

inline py::array array_of(render::Image picture) {
    const auto kept = std::make_shared<const render::Image>(std::move(picture));
    static_assert(sizeof(render::Rgba) == 4);
    return array_over(reinterpret_cast<const std::uint8_t*>(kept->pixels.data()), {kept->height, kept->width, 4}, kept);
}

inline py::bytes png_of(const py::array& array) {
    if (!py::isinstance<py::array_t<std::uint8_t>>(array) || array.ndim() != 3 || array.shape(2) != 4 || array.size() == 0)
        throw UsageError("a picture is height x width x 4 uint8, not " + shape_of(array) + " " + std::string(py::str(array.dtype())));
    render::Image picture(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
    const py::array_t<std::uint8_t, py::array::c_style> rows(array);
    std::copy_n(rows.data(), rows.size(), reinterpret_cast<std::uint8_t*>(picture.pixels.data()));
    return render::encode_png(picture);
}

/// Returns the options that are given, by the names of their arguments in Python.
inline run::PictureWords words_of(const py::dict& given) {
    const auto text = [&](const char* key) { return given.contains(key) ? given[key].cast<std::string>() : std::string(); };
    return {.views = text("views"),
            .size = text("size"),
            .field = text("field"),
            .colormap = text("colormap"),
            .range = text("range"),
            .isolines = text("isolines"),
            .title = text("title"),
            .background = text("background"),
            .width = text("width_mm"),
            .dpi = text("dpi"),
            .columns = text("columns"),
            .fit = text("fit"),
            .bar = text("bar"),
            .sight = {text("camera"), text("up"), text("zoom")},
            .edges = text("edges") == "on"};
}

inline py::array draw(const Mesh& mesh, const py::object& values, const std::string& label, const py::dict& options) {
    const run::PictureWords words = words_of(options);
    std::optional<run::Field> given;
    if (values.is_none()) run::require_choice("field", words.field, run::field_names());
    else given = run::field_of_values(values_of(values, mesh.triangles().X.rows()), label);
    run::PictureRequest request = run::picture_request(words);
    if (!request.colors.warning.empty()) warn(request.colors.warning);
    request.title = std::filesystem::path(mesh.prepared->file).filename().string();
    request.draw.face_colors_from_id = !given && words.field == "id";
    return array_of(interruptible([=, of = mesh.prepared](const Stop& stop) {
        const run::Field field = given ? *given : run::field_of(*of, words.field);
        stop.check();
        run::MeshPictures drawn = run::draw_pictures(*of, field, request);
        stop.check();
        return drawn.sheet.pictures.size() == 1 ? std::move(drawn.sheet.pictures.front())
                                                : run::composed(drawn.sheet, request.draw.face_colors_from_id);
    }));
}

/// @param values  for each label an array a mesh @param path  the file to write; None: a picture is returned
inline py::object figure(const std::vector<Mesh>& meshes, const std::vector<std::string>& labels, const std::vector<std::string>& fields,
                         const std::vector<std::pair<std::string, std::vector<py::object>>>& values, const py::object& path,
                         const py::dict& options) {
    if (!fields.empty() || values.empty()) run::require_figure_fields(fields);
    const std::string file = path.is_none() ? "" : path.cast<std::string>();
    run::check_output("path", file, {".pdf", ".svg", ".png"});
    run::FigureStyle style = run::figure_style(words_of(options));
    if (!style.colors.warning.empty()) warn(style.colors.warning);
    style.labels_single = !labels.empty();
    std::vector<PreparedMesh> prepared;
    std::vector<std::vector<run::Field>> given(meshes.size());
    for (const Mesh& mesh : meshes) prepared.push_back(*mesh.prepared);
    for (const auto& [label, arrays] : values)
        for (std::size_t i = 0; i < meshes.size(); ++i)
            given[i].push_back(run::field_of_values(values_of(arrays[i], meshes[i].triangles().X.rows()), label));
    auto [picture, bytes] = interruptible([=](const Stop& stop) {
        std::vector<run::FigureMesh> drawn = run::figure_meshes(prepared, labels.empty() ? run::labels_of(prepared) : labels, fields);
        for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].fields.insert(drawn[i].fields.end(), given[i].begin(), given[i].end());
        stop.check();
        return file.empty() ? std::pair{render::painted(run::figure_of(drawn, style)), std::string()}
                            : std::pair{render::Image(), run::encode_figure(drawn, style, lower_case_ending(file))};
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
    m.def("save_png", [](const py::array& picture, const std::string& path) {
        run::check_output("path", path, {".png"});
        output::replace_file(path, png_of(picture).cast<std::string>());
    });
}

}   // namespace meshfolio::python
