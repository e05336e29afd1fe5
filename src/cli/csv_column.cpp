#include "cli/csv_column.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "errors.h"
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

Vector csv_column(std::string_view text, const std::string& file, const std::string& column, Eigen::Index rows) {
    std::string_view rest = text;
    const std::vector<std::string_view> header = split(next_line(rest), ',');
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end())
        throw InputError({file, 1}, "no column '" + column + "'", "the header is '" + std::string(text.substr(0, text.find('\n'))) + "'");
    const auto at = static_cast<std::size_t>(found - header.begin());

    Vector values = Vector::Constant(rows, std::numeric_limits<double>::quiet_NaN());
    long line = 1;
    for (Eigen::Index v = 0; v < rows; ++v) {
        ++line;
        if (rest.empty()) {
            throw InputError({file, line}, "ends after " + std::to_string(v) + " rows, the mesh has " + std::to_string(rows) + " vertices");
        }
        const std::vector<std::string_view> cells = split(next_line(rest), ',');
        if (cells.size() != header.size()) {
            throw InputError({file, line}, std::to_string(cells.size()) + " cells, the header has " + std::to_string(header.size()));
        }
        if (cells[at].empty()) continue;
        const auto value = parse_number(cells[at]);
        if (!value) throw InputError({file, line}, "'" + std::string(cells[at]) + "' is not a finite number");
        values[v] = *value;
    }
    if (!rest.empty()) throw InputError({file, line + 1}, "more rows than the mesh has vertices (" + std::to_string(rows) + ")");
    return values;
}

}   // namespace meshfolio::cli
