#include "cli/csv_column.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio::cli {

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

}   // namespace meshfolio::cli
