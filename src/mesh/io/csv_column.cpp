#include "mesh/io/csv_column.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

constexpr const char* csv_remedy = "write a header and one row a vertex, such as meshfolio curvature --csv gives";

std::size_t cell_count(std::string_view line) { return 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')); }

/// A cell of a line that has so many. Quotes are not taken off: numbers have none.
std::string_view cell(std::string_view line, std::size_t number) {
    for (; number > 0; --number) line.remove_prefix(line.find(',') + 1);
    return line.substr(0, line.find(','));
}

std::string_view without_blanks(std::string_view word) {
    const std::size_t first = word.find_first_not_of(" \t"), last = word.find_last_not_of(" \t");
    return first == std::string_view::npos ? std::string_view() : word.substr(first, last - first + 1);
}

bool is_nan_word(std::string_view word) {
    return word.size() == 3 && std::ranges::equal(word, std::string_view("nan"), [](char a, char b) { return (a | 0x20) == b; });
}

/// The place of a column in the header.
std::size_t column_named(const std::string& column, std::string_view header, bool lenient, const std::string& file) {
    const std::size_t count = cell_count(header);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view name = cell(header, i);
        if ((lenient ? without_blanks(name) : name) == column) return i;
    }
    throw InputError({file, 1}, "no column " + in_quotes(column), "the header is " + in_quotes(header, 200));
}

double value_of(std::string_view word, bool lenient, const Location& here) {
    if (lenient) word = without_blanks(word);
    if (word.empty() || (lenient && is_nan_word(word))) return std::numeric_limits<double>::quiet_NaN();
    const auto value = parse_number(word);
    if (!value) throw InputError(here, in_quotes(word) + " is not a finite number", "leave the cell empty where there is no value");
    if (std::abs(*value) > largest_coordinate)   // differences must not overflow
        throw InputError(here, in_quotes(word) + " is out of the supported range (1e100)", "scale the values");
    return *value;
}

}   // namespace

Vector csv_column(std::string_view bytes, const std::string& file, const std::string& column, const CsvRules& rules) {
    refuse_nul_bytes(bytes, file);
    LineScanner lines(without_bom(bytes));
    if (!lines.next()) throw InputError({file, 0}, "file is empty", csv_remedy);
    const std::size_t columns = cell_count(lines.line()), place = column_named(column, lines.line(), rules.lenient, file);
    const std::string of_the_mesh = "the mesh has " + std::to_string(rules.rows.value_or(0)) + " vertices";
    std::vector<double> values;
    while (!rules.rows || static_cast<Eigen::Index>(values.size()) < *rules.rows) {
        if (!lines.next()) {
            if (!rules.rows) break;
            throw InputError({file, lines.number()}, "ends after " + std::to_string(values.size()) + " rows, " + of_the_mesh, csv_remedy);
        }
        const Location here{file, lines.number()};
        const std::size_t cells = cell_count(lines.line());
        if (cells != columns)
            throw InputError(here, std::to_string(cells) + " cells, the header has " + std::to_string(columns), csv_remedy);
        values.push_back(value_of(cell(lines.line(), place), rules.lenient, here));
    }
    if (rules.rows && lines.next()) throw InputError({file, lines.number()}, "more rows than " + of_the_mesh, csv_remedy);
    return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

std::vector<std::string> csv_header(std::string_view bytes, const std::string& file) {
    LineScanner lines(without_bom(bytes));
    if (!lines.next()) throw InputError({file, 0}, "file is empty", csv_remedy);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < cell_count(lines.line()); ++i) names.emplace_back(without_blanks(cell(lines.line(), i)));
    return names;
}

}   // namespace meshfolio
