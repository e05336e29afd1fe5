// The view model of tables: digits, alignment, best values, rows left out.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/number_text.h"
#include "report/escape.h"
#include "report/page/view_blocks.h"
#include "report/page/view_value.h"

namespace meshfolio::report {

namespace {

using nlohmann::json;

constexpr std::size_t most_columns = 8;   // in the usual type across a sheet of A4

const double* number_in(const std::vector<Cell>& row, std::size_t column) {
    return column < row.size() ? std::get_if<double>(&row[column]) : nullptr;
}

enum class Notation { whole, plain, scientific };

/// Returns a number of the column as it is printed; "–" for an undefined one.
std::string number_text(double x, const Column& column, Notation notation) {
    using Rounding = Column::Rounding;
    int digits = column.digits;
    if (column.rounding == Rounding::down) x = rounded_down(x, digits);
    if (column.rounding == Rounding::up) x = rounded_up(x, digits);
    if (column.rounding == Rounding::tenths && std::isfinite(x)) {
        x = std::round(10 * x) / 10;
        digits = std::abs(x) < 1 ? 1 : 2 + static_cast<int>(std::floor(std::log10(std::abs(x))));   // for one decimal
    }
    const bool near_one = std::abs(x) >= 0.01 && std::abs(x) < 1e5;
    if (notation == Notation::scientific && !near_one) return scientific_text(x, digits);
    return notation == Notation::whole ? readable_integer(x) : readable(x, digits);
}

/// Returns figure spaces that align the decimal points of a right-aligned column; none if a text has a power of ten.
std::vector<std::string> paddings_of(const std::vector<std::string>& texts) {
    std::vector<std::size_t> decimals;   // characters from the point to the end
    for (const std::string& text : texts) {
        if (text.find("×") != std::string::npos) return std::vector<std::string>(texts.size());
        decimals.push_back(text.size() - std::min(text.find('.'), text.size()));
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

/// The values that the cells of a column share.
struct ColumnView {
    bool numeric, reference;
    std::optional<double> best;                 // to be marked; empty if none is asked for or all values are equal
    std::vector<std::string> texts, paddings;   // one a row
};

ColumnView column_view(const Table& table, std::size_t c) {
    const Column& column = table.columns[c];
    bool has_words = false, has_numbers = false, whole = true, power = false;
    std::vector<double> values;   // finite ones
    for (const auto& row : table.rows) {
        has_words = has_words || (c < row.size() && std::holds_alternative<std::string>(row[c]));
        const double* x = number_in(row, c);
        has_numbers = has_numbers || x;
        if (!x || !std::isfinite(*x)) continue;
        values.push_back(*x);
        whole = whole && std::trunc(*x) == *x && std::abs(*x) < 1e9;
        power = power || readable(*x, column.digits).find("×") != std::string::npos;
    }
    ColumnView view{has_numbers && !has_words, column.reference, {}, {}, {}};
    if (column.best != Column::Best::none && !values.empty()) {
        const auto [smallest, largest] = std::ranges::minmax(values);
        if (smallest != largest) view.best = column.best == Column::Best::smallest ? smallest : largest;
    }
    // Counts are whole. If one number needs a power of ten, all numbers far from 1 have one.
    const Notation notation = whole ? Notation::whole : power ? Notation::scientific : Notation::plain;
    for (const auto& row : table.rows) {
        const double* x = number_in(row, c);
        view.texts.push_back(number_text(x ? *x : std::nan(""), column, notation));
    }
    view.paddings = view.numeric ? paddings_of(view.texts) : std::vector<std::string>(view.texts.size());
    return view;
}

/// True if a cell refers to the other volume without a link.
bool refers_elsewhere(const Table& table, const Numbering& numbering) {
    for (const auto& row : table.rows) {
        for (std::size_t c = 0; c < std::min(row.size(), table.columns.size()); ++c) {
            const auto* id = std::get_if<std::string>(&row[c]);
            if (id != nullptr && table.columns[c].reference && numbering.resolve(*id).elsewhere && numbering.resolve(*id).page.empty())
                return true;
        }
    }
    return false;
}

json row_view(const Table& table, std::size_t r, const std::vector<ColumnView>& columns, const Numbering& numbering) {
    json cells = json::array();
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const double* x = number_in(table.rows[r], c);
        const auto* words = c < table.rows[r].size() ? std::get_if<std::string>(&table.rows[r][c]) : nullptr;
        const bool refers = words != nullptr && columns[c].reference;
        const auto view = c == 0 ? letters_view : prose_view;
        json cell = refers ? text_view({ref(*words)}, numbering) : view(words ? *words : "");
        if (refers) cell["runs"][0]["is_elsewhere"] = false;   // the caption says it
        const auto& range = table.columns[c].heat;
        std::string heat;
        if (x && range) {   // steps of equal ratio
            constexpr int steps = 6;
            const double place = std::log(std::abs(*x) / range->low) / std::log(range->high / range->low);
            heat = std::to_string(std::isnan(place) ? 0 : std::lround(steps * std::clamp(place, 0.0, 1.0)));
        }
        enter(cell, {{"is_words", "it holds words: runs", words != nullptr},
                     {"number", "as people read it", columns[c].texts[r]},
                     {"padding", "figure spaces that align decimal points", columns[c].paddings[r]},
                     {"is_numeric", "it holds a number or nothing", columns[c].numeric},
                     {"has_value", "it is defined", x && std::isfinite(*x)},
                     {"value", "with all digits, for sorting", x ? exact_text(*x) : ""},
                     {"is_best", "the best of its column", x && columns[c].best && *x == *columns[c].best},
                     {"has_heat", "it is shaded", !heat.empty()},
                     {"heat", "how strongly, 1 to 6", heat},
                     {"is_row_header", "it names the row", c == 0}});
        cells.push_back(std::move(cell));
    }
    return view_of({{"cells", "of a row", std::move(cells)}, {"is_gap", "rows are left out here", false}});
}

/// Returns the row that gives the number of rows left out.
json gap_view(std::size_t left_out, std::size_t columns) {
    std::string bars;
    for (std::size_t c = 1; c < columns; ++c) bars += " |";
    return view_of({{"cells", "of a row", json::array()},
                    {"is_gap", "rows are left out here", true},
                    {"left_out", "how many: \"1 row\", \"410 rows\"",
                     readable_integer(static_cast<double>(left_out)) + (left_out == 1 ? " row" : " rows")},
                    {"columns", "how many columns the table has", std::to_string(columns)},
                    {"fill", "bars that complete this row in Markdown", std::move(bars)}});
}

}   // namespace

json table_view(const Table& table, const ViewContext& context) {
    std::vector<ColumnView> columns;
    json heads = json::array();
    bool has_best = false;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const Column& column = table.columns[c];
        columns.push_back(column_view(table, c));
        has_best = has_best || columns.back().best;
        heads.push_back(view_of({{"name", "of the column", letters_view(column.name)},
                                 {"unit", "of its numbers", safe_text(column.unit)},
                                 {"has_unit", "there is one", !column.unit.empty()},
                                 {"is_filter", "readers may choose one of its values", column.filter},
                                 {"is_numeric", "it holds numbers", columns.back().numeric}}));
    }
    const std::size_t shown = std::max<std::size_t>(context.options.table_rows, 2), total = table.rows.size();
    const bool whole = total < shown + std::max<std::size_t>(context.options.fewest_left_out, 1);
    const std::size_t first = whole ? total : (shown + 1) / 2, last = whole ? 0 : shown / 2;
    json rows = json::array();
    for (std::size_t r = 0; r < first; ++r) rows.push_back(row_view(table, r, columns, context.numbering));
    if (!whole) rows.push_back(gap_view(total - first - last, columns.size()));
    for (std::size_t r = total - last; r < total; ++r) rows.push_back(row_view(table, r, columns, context.numbering));
    const bool worth_sorting = table.sortable || total >= 3;
    json view = captioned_view(table.id, table.caption, context);
    enter(view, {{"csv", "link to the data", url_path("tables/" + table.id + ".csv")},
                 {"columns", "heads of a table", std::move(heads)},
                 {"rows", "of a table", std::move(rows)},
                 {"is_sortable", "readers may sort it", whole && worth_sorting},
                 {"has_many_columns", "the table has so many columns that its print is small", table.columns.size() > most_columns},
                 {"has_best", "a value of it is marked as best", has_best},
                 {"has_references_elsewhere", "cells name what is in the other volume, and no page can be linked to (print.html only)",
                  refers_elsewhere(table, context.numbering)}});
    return view;
}

}   // namespace meshfolio::report
