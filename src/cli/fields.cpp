#include "cli/fields.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "errors.h"
#include "file_bytes.h"
#include "geometry/curvature.h"
#include "geometry/laplace_operator.h"
#include "mesh/triangle_measures.h"
#include "nearest_word.h"
#include "number_text.h"

namespace meshfolio::cli {

namespace {

std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t at = line.find(separator);
        cells.push_back(line.substr(0, at));
        if (at == std::string_view::npos) return cells;
        line.remove_prefix(at + 1);
    }
}

/// Takes the first line off `text`, without its line end.
std::string_view next_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

}   // namespace

std::vector<std::string> field_names() {
    std::vector<std::string> names{"none", "h-uniform"};
    for (const OperatorEntry& entry : operator_list()) {
        if (entry.kind != OperatorKind::uniform) names.push_back("h-" + std::string(entry.name));
    }
    names.insert(names.end(), {"gauss", "area", "x", "y", "z", "id"});
    return names;
}

// Only the mean over the neighbours asks who they are.
Checks checks_for(const std::string& name) { return name == "h-uniform" ? Checks::all : Checks::for_pictures; }

Field field_of(const PreparedMesh& mesh, const std::string& name) {
    if (name == "none" || name == "id") return {};
    const double diagonal = Box{mesh.preflight.box_low, mesh.preflight.box_high}.diagonal();
    if (name == "h-uniform") return {uniform_mean_curvature(mesh.mesh, mesh.topology), "½‖Δx‖, uniform", "length", true, 1e-9 * diagonal};
    for (const OperatorEntry& entry : operator_list()) {
        if (name != "h-" + std::string(entry.name)) continue;
        const LaplaceBeltrami laplacian = laplace_operator(mesh.mesh, entry.kind);
        return {operator_mean_curvature(mesh.mesh, mesh.topology, entry.kind, laplacian), "mean curvature H", "1/length", true,
                1e-6 / diagonal};
    }
    if (name == "gauss") {
        return {gaussian_curvature(mesh.mesh, mesh.topology, vertex_areas(mesh.mesh, AreaForm::barycentric)), "Gaussian curvature K",
                "1/length²", true, 1e-6 / (diagonal * diagonal)};
    }
    if (name == "area")
        return {vertex_areas(mesh.mesh, AreaForm::barycentric), "barycentric area", "length²", false, 1e-12 * diagonal * diagonal};
    for (const auto& [axis, column] : {std::pair{"x", 0}, std::pair{"y", 1}, std::pair{"z", 2}}) {
        if (name == axis) return {mesh.mesh.X.col(column), name, "length", false, 1e-9 * diagonal};
    }
    throw UsageError("unknown field '" + name + "'", "did you mean '" + nearest_word(name, field_names()) + "'?");
}

Field field_from_csv(const PreparedMesh& mesh, const std::string& file_and_column) {
    const std::size_t colon = file_and_column.rfind(':');
    if (colon == std::string::npos) throw UsageError("--values needs FILE.csv:COLUMN, not '" + file_and_column + "'");
    const std::string file = file_and_column.substr(0, colon), column = file_and_column.substr(colon + 1);
    const std::string bytes = read_file(file);
    std::string_view rest = bytes;
    const std::vector<std::string_view> header = split(next_line(rest), ',');
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end())
        throw InputError({file, 1}, "no column '" + column + "'", "the header is '" + bytes.substr(0, bytes.find('\n')) + "'");
    const auto at = static_cast<std::size_t>(found - header.begin());

    Field field;
    field.quantity = column;
    field.values = Vector::Constant(mesh.mesh.vertex_count(), std::numeric_limits<double>::quiet_NaN());
    long line = 1;
    for (Eigen::Index v = 0; v < field.values.size(); ++v) {
        ++line;
        if (rest.empty()) {
            throw InputError({file, line}, "ends after " + std::to_string(v) + " rows, the mesh has " +
                                               std::to_string(field.values.size()) + " vertices");
        }
        const std::vector<std::string_view> cells = split(next_line(rest), ',');
        if (cells.size() != header.size()) {
            throw InputError({file, line}, std::to_string(cells.size()) + " cells, the header has " + std::to_string(header.size()));
        }
        if (cells[at].empty()) continue;
        const auto value = parse_number(cells[at]);
        if (!value) throw InputError({file, line}, "'" + std::string(cells[at]) + "' is not a finite number");
        field.values[v] = *value;
    }
    if (!rest.empty())
        throw InputError({file, line + 1}, "more rows than the mesh has vertices (" + std::to_string(field.values.size()) + ")");
    const double low = field.values.array().isNaN().select(0, field.values).minCoeff();
    const double high = field.values.array().isNaN().select(0, field.values).maxCoeff();
    field.is_signed = low < 0 && high > 0;
    field.floor = 1e-9 * std::max(std::abs(low), std::abs(high));
    return field;
}

}   // namespace meshfolio::cli
