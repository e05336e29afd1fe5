#include "run/one_mesh/fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "geometry/curvature/curvature.h"
#include "geometry/operators/laplace_operator.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::run {

std::vector<std::string> operator_choices() {
    std::vector<std::string> names;
    for (const OperatorEntry& entry : operator_list()) names.emplace_back(entry.name);
    return names;
}

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
    const double diagonal = bounding_box(mesh.mesh).diagonal();
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
    throw UsageError("unknown field " + in_quotes(name), "did you mean '" + nearest_word(name, field_names()) + "'?");
}

Field field_from_csv(const PreparedMesh& mesh, const std::string& file_and_column) {
    const std::size_t colon = file_and_column.rfind(':');
    if (colon == std::string::npos) throw UsageError("--values needs FILE.csv:COLUMN, not " + in_quotes(file_and_column), "name both");
    const std::string file = file_and_column.substr(0, colon), column = file_and_column.substr(colon + 1);
    if (file.empty() || column.empty()) throw UsageError("--values needs FILE.csv:COLUMN, not " + in_quotes(file_and_column), "name both");
    return field_of_values(csv_column(read_file(file, largest_csv), file, column, mesh.mesh.vertex_count()), column);
}

Field field_of_values(Vector values, const std::string& quantity) {
    Field field{.values = std::move(values), .quantity = quantity, .unit = ""};
    const double low = field.values.array().isNaN().select(0, field.values).minCoeff();
    const double high = field.values.array().isNaN().select(0, field.values).maxCoeff();
    field.is_signed = low < 0 && high > 0;
    field.floor = 1e-9 * std::max(std::abs(low), std::abs(high));
    return field;
}

namespace {

constexpr const char* csv_remedy = "write a header and one row a vertex, such as meshfolio curvature --csv gives";

std::size_t cell_count(std::string_view line) { return 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')); }

/// A cell of a line that has so many. Quotes are not taken off: numbers have none.
std::string_view cell(std::string_view line, std::size_t number) {
    for (; number > 0; --number) line.remove_prefix(line.find(',') + 1);
    return line.substr(0, line.find(','));
}

/// The place of a column in the header.
std::size_t column_named(const std::string& column, std::string_view header, const std::string& file) {
    const std::size_t count = cell_count(header);
    std::string_view rest = header;
    for (std::size_t i = 0; i < count; ++i) {
        if (cell(rest, 0) == column) return i;
        rest.remove_prefix(std::min(rest.find(','), rest.size() - 1) + 1);
    }
    throw InputError({file, 1}, "no column " + in_quotes(column), "the header is " + in_quotes(header, 200));
}

}   // namespace

Vector csv_column(std::string_view bytes, const std::string& file, const std::string& column, Eigen::Index rows) {
    refuse_nul_bytes(bytes, file);
    LineScanner lines(without_bom(bytes));
    if (!lines.next()) throw InputError({file, 0}, "file is empty", csv_remedy);
    const std::size_t columns = cell_count(lines.line()), place = column_named(column, lines.line(), file);
    const std::string of_the_mesh = "the mesh has " + std::to_string(rows) + " vertices";
    Vector values = Vector::Constant(rows, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index v = 0; v < rows; ++v) {
        if (!lines.next())
            throw InputError({file, lines.number()}, "ends after " + std::to_string(v) + " rows, " + of_the_mesh, csv_remedy);
        const Location here{file, lines.number()};
        const std::size_t cells = cell_count(lines.line());
        if (cells != columns)
            throw InputError(here, std::to_string(cells) + " cells, the header has " + std::to_string(columns), csv_remedy);
        const std::string_view word = cell(lines.line(), place);
        if (word.empty()) continue;
        const auto value = parse_number(word);
        if (!value) throw InputError(here, in_quotes(word) + " is not a finite number", "leave the cell empty where there is no value");
        if (std::abs(*value) > largest_coordinate)   // differences must not overflow
            throw InputError(here, in_quotes(word) + " is out of the supported range (1e100)", "scale the values");
        values[v] = *value;
    }
    if (lines.next()) throw InputError({file, lines.number()}, "more rows than " + of_the_mesh, csv_remedy);
    return values;
}

}   // namespace meshfolio::run
