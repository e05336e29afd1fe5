#include "run/one_mesh/fields.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "base/at.h"
#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "geometry/curvature/curvature.h"
#include "geometry/curvature/jet_fit.h"
#include "mesh/io/csv_column.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/polygon_list.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::run {

std::vector<std::string> operator_choices() {
    std::vector<std::string> names;
    for (const OperatorEntry& entry : operator_list()) names.emplace_back(entry.name);
    return names;
}

std::vector<std::string> area_choices() { return {"barycentric", "voronoi", "mixed"}; }

std::vector<std::string> field_names() {
    std::vector<std::string> names{"none", "h-uniform"};
    for (const OperatorEntry& entry : operator_list())
        if (entry.kind != OperatorKind::uniform) names.push_back("h-" + std::string(entry.name));
    names.insert(names.end(), {"gauss", "area", "x", "y", "z", "id"});
    return names;
}

// Only the mean over the neighbours needs the topology.
Checks checks_for(const std::string& name) { return name == "h-uniform" ? Checks::all : Checks::for_pictures; }

Field field_of(const PreparedMesh& mesh, const std::string& name) {
    if (name == "none" || name == "id") return {};
    const double diagonal = Box{mesh.preflight.box_low, mesh.preflight.box_high}.diagonal();
    if (name == "h-uniform")
        return {uniform_mean_curvature(mesh.mesh, mesh.topology), "½‖Δx‖, uniform", "length", "diverging", 1e-9 * diagonal};
    for (const OperatorEntry& entry : operator_list()) {
        if (name != "h-" + std::string(entry.name)) continue;
        const LaplaceBeltrami laplacian = laplace_operator(mesh.mesh, entry.kind);
        return {operator_mean_curvature(mesh.mesh, mesh.topology, entry.kind, laplacian), "mean curvature H", "1/length", "diverging",
                1e-6 / diagonal};
    }
    if (name == "gauss") {
        return {gaussian_curvature(mesh.mesh, mesh.topology, vertex_areas(mesh.mesh, AreaForm::barycentric)), "Gaussian curvature K",
                "1/length²", "diverging", 1e-6 / (diagonal * diagonal)};
    }
    if (name == "area")
        return {vertex_areas(mesh.mesh, AreaForm::barycentric), "barycentric area", "length²", "viridis", 1e-12 * diagonal * diagonal};
    for (const auto& [axis, column] : {std::pair{"x", 0}, std::pair{"y", 1}, std::pair{"z", 2}})
        if (name == axis) return {mesh.mesh.X.col(column), name, "length", "viridis", 1e-9 * diagonal};
    throw UsageError("unknown field " + in_quotes(name), "did you mean '" + nearest_word(name, field_names()) + "'?");
}

namespace {

Vector mesh_column(const std::string& file, const std::string& name, int vertices) {
    const LoadedMesh loaded = read_mesh(file, Keep::attributes);
    if (loaded.mesh.vertex_count() != vertices) {
        throw InputError({file, 0},
                         "it has " + std::to_string(loaded.mesh.vertex_count()) + " vertices, the mesh " + std::to_string(vertices),
                         "name a file with one value for each vertex of the mesh");
    }
    std::vector<std::string> names;
    for (const VertexColumn& column : loaded.attributes.columns) {
        if (column.name == name) return (column.values.array().abs() <= largest_coordinate).select(column.values, std::nan(""));
        names.push_back(column.name);
    }
    throw InputError({file, 0}, "no property " + in_quotes(name) + " of vertices",
                     names.empty() ? "it has none" : suggestion(name, names) + "it has " + meshfolio::joined(names, ", "));
}

}   // namespace

Field field_from_file(const PreparedMesh& mesh, const std::string& file_and_column) {
    const std::size_t colon = file_and_column.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == file_and_column.size())
        throw UsageError("--values needs FILE:COLUMN, not " + in_quotes(file_and_column),
                         "name a file and one of its columns: values.csv:error");
    const std::string file = file_and_column.substr(0, colon), column = file_and_column.substr(colon + 1);
    const int vertices = mesh.mesh.vertex_count();
    if (is_mesh_file(file)) return field_of_values(mesh_column(file, column, vertices), column);
    NumberColumn read = csv_column(read_file(file, largest_csv), file, {column}, vertices);
    if (read.first_infinite > 0)
        throw InputError({file, read.first_infinite}, "an infinite value has no colour", "leave the cell empty where there is no value");
    return field_of_values(std::move(read.values), column);
}

Field field_of_values(Vector values, const std::string& quantity) {
    Field field{.values = std::move(values), .quantity = quantity, .unit = ""};
    const double low = field.values.array().isNaN().select(0, field.values).minCoeff();
    const double high = field.values.array().isNaN().select(0, field.values).maxCoeff();
    if (low < 0 && high > 0) field.colormap = "diverging";
    field.floor = 1e-9 * std::max(std::abs(low), std::abs(high));
    return field;
}

std::vector<VertexColumn> curvature_columns(const PreparedMesh& prepared, AreaForm form, OperatorKind kind, bool with_jets) {
    const auto& [mesh, topology] = std::tie(prepared.mesh, prepared.topology);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh, form);
    const Vector& areas = laplacian.M;
    std::vector<VertexColumn> columns{{"area", (areas.array() > 0).select(areas, std::nan(""))},
                                      {"h_uniform", uniform_mean_curvature(mesh, topology)},
                                      {"k_gauss", gaussian_curvature(mesh, topology, areas)},
                                      {"h_cotan", cotangent_mean_curvature(mesh, topology, laplacian)},
                                      {"h_uniform_scaled", uniform_mean_curvature_scaled(mesh, topology)}};
    if (with_jets) {
        JetCurvature jet = jet_curvature(mesh, topology);
        columns.push_back({"h_jet", std::move(jet.H)});
        columns.push_back({"k_jet", std::move(jet.K)});
    }
    const bool has_column = kind == OperatorKind::cotan || kind == OperatorKind::uniform;   // h_cotan, h_uniform_scaled
    if (has_column) return columns;
    std::string name = "h_" + std::string(operator_entry(kind).name);   // h_idt, h_cotan_no_half, …
    std::ranges::replace(name, '-', '_');
    columns.push_back({name, operator_mean_curvature(mesh, topology, kind, laplace_operator(mesh, kind, form))});
    return columns;
}

Attributes attributes_with(const PreparedMesh& prepared, std::vector<VertexColumn> columns) {
    Attributes all = prepared.attributes;
    std::erase_if(all.columns,
                  [&](const VertexColumn& old) { return std::ranges::find(columns, old.name, &VertexColumn::name) != columns.end(); });
    std::ranges::move(columns, std::back_inserter(all.columns));
    return all;
}

std::string vertex_table(const PreparedMesh& prepared, const std::vector<VertexColumn>& columns) {
    std::string csv = "vertex,x,y,z,boundary";
    for (const VertexColumn& column : columns) csv += ',' + column.name;
    csv += '\n';
    for (int v = 0; v < prepared.mesh.vertex_count(); ++v) {
        csv += std::to_string(v);
        for (int axis = 0; axis < 3; ++axis) csv += ',' + exact_text(prepared.mesh.X(v, axis));
        csv += prepared.topology.on_boundary[at(v)] ? ",1" : ",0";
        for (const VertexColumn& column : columns) csv += ',' + exact_text(column.values[v]);
        csv += '\n';
    }
    return csv;
}

}   // namespace meshfolio::run
