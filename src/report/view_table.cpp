// Tables as the templates see them: digits, alignment, best values, rows left out.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "number_text.h"
#include "report/escape.h"
#include "report/view_blocks.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

const double* number_in(const std::vector<Cell>& row, std::size_t column) {
    return column < row.size() ? std::get_if<double>(&row[column]) : nullptr;
}

bool is_numeric(const Table& table, std::size_t column) {
    bool any = false;
    for (const auto& row : table.rows) {
        if (column < row.size() && std::holds_alternative<std::string>(row[column])) return false;
        any = any || number_in(row, column);
    }
    return any;
}

/// The value to be marked in a column, where there is a choice.
std::optional<double> best_of(const Table& table, std::size_t column) {
    if (table.columns[column].best == Column::Best::none) return {};
    std::vector<double> values;
    for (const auto& row : table.rows) {
        const double* x = number_in(row, column);
        if (x && std::isfinite(*x)) values.push_back(*x);
    }
    if (values.empty()) return {};
    const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
    if (*smallest == *largest) return {};
    return table.columns[column].best == Column::Best::smallest ? *smallest : *largest;
}

std::string cell_text(const std::vector<Cell>& row, std::size_t column, const Column& format) {
    if (const double* x = number_in(row, column)) return readable(*x, format.digits);
    if (column < row.size()) {
        if (const auto* words = std::get_if<std::string>(&row[column])) return safe_text(*words);
    }
    return "–";
}

/// Characters from the decimal point to the end; nothing for numbers written with a power of ten.
std::optional<std::size_t> decimals_of(const std::string& number) {
    if (number.find("×") != std::string::npos) return {};
    const std::size_t point = number.find('.');
    return point == std::string::npos ? 0 : number.size() - point;
}

/// Figure spaces that put the decimal points of a right-aligned column under each other; none where powers of ten are mixed in.
std::vector<std::string> paddings_of(const Table& table, std::size_t column) {
    std::vector<std::size_t> decimals;
    for (const auto& row : table.rows) {
        const double* x = number_in(row, column);
        const auto count = decimals_of(x ? readable(*x, table.columns[column].digits) : "");
        if (!count) return std::vector<std::string>(table.rows.size());
        decimals.push_back(*count);
    }
    const std::size_t most = decimals.empty() ? 0 : *std::max_element(decimals.begin(), decimals.end());
    std::vector<std::string> paddings;
    for (const std::size_t count : decimals) {
        std::string padding = count == 0 && most > 0 ? "\u2008" : "";   // as wide as the point
        for (std::size_t i = std::max<std::size_t>(count, 1); i < most; ++i) padding += "\u2007";
        paddings.push_back(std::move(padding));
    }
    return paddings;
}

struct ColumnView {
    bool numeric;
    std::optional<double> best;
    std::vector<std::string> paddings;   // one a row
};

json row_view(const Table& table, std::size_t r, const std::vector<ColumnView>& columns) {
    json cells = json::array();
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const double* x = number_in(table.rows[r], c);
        cells.push_back({{"text", cell_text(table.rows[r], c, table.columns[c])},
                         {"padding", columns[c].numeric ? columns[c].paddings[r] : ""},
                         {"is_numeric", columns[c].numeric},
                         {"is_best", x && columns[c].best && *x == *columns[c].best},
                         {"is_row_header", c == 0}});
    }
    return {{"cells", std::move(cells)}, {"is_gap", false}};
}

/// A row that says how many are not shown.
json gap_view(std::size_t left_out, std::size_t columns) {
    return {{"cells", json::array()}, {"is_gap", true}, {"left_out", std::to_string(left_out)}, {"columns", std::to_string(columns)}};
}

}   // namespace

json table_view(const Table& table, const ViewContext& context) {
    std::vector<ColumnView> columns;
    json heads = json::array();
    bool has_best = false;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const Column& column = table.columns[c];
        columns.push_back({is_numeric(table, c), best_of(table, c), paddings_of(table, c)});
        has_best = has_best || columns.back().best;
        heads.push_back({{"name", safe_text(column.name)},
                         {"unit", safe_text(column.unit)},
                         {"has_unit", !column.unit.empty()},
                         {"is_numeric", columns.back().numeric}});
    }
    const std::size_t shown = std::max<std::size_t>(context.options.table_rows, 2), total = table.rows.size();
    const std::size_t first = total <= shown ? total : (shown + 1) / 2, last = total <= shown ? 0 : shown / 2;
    json rows = json::array();
    for (std::size_t r = 0; r < first; ++r) rows.push_back(row_view(table, r, columns));
    if (first + last < total) rows.push_back(gap_view(total - first - last, columns.size()));
    for (std::size_t r = total - last; r < total; ++r) rows.push_back(row_view(table, r, columns));
    const Reference self = context.numbering.resolve(table.id);
    return {{"id", safe_text(table.id)},           {"label", self.label},
            {"caption", safe_text(table.caption)}, {"csv", url_path("tables/" + table.id + ".csv")},
            {"columns", std::move(heads)},         {"rows", std::move(rows)},
            {"is_cut", first + last < total},      {"has_best", has_best}};
}

}   // namespace meshfolio::report
