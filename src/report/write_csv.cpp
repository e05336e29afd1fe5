// RFC 4180 with LF line ends.

#include <algorithm>
#include <string_view>

#include "base/number_text.h"
#include "report/escape.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

/// True if spreadsheets may run the cell as a formula (OWASP, CSV injection). Some skip blanks and quotes before the sign; the last four
/// signs are the wide forms of the first. A number is no formula.
bool is_formula(std::string_view cell) {
    cell.remove_prefix(std::min(cell.find_first_not_of(" \"'"), cell.size()));
    if (parse_number(cell)) return false;
    constexpr std::string_view signs[] = {"=", "+", "-", "@", "\uFF1D", "\uFF0B", "\uFF0D", "\uFF20"};
    return std::ranges::any_of(signs, [&](std::string_view sign) { return cell.starts_with(sign); });
}

/// Returns a text as a field, with "'" before formulas: at its beginning, and behind characters that separate cells in other settings.
std::string field(const std::string& raw) {
    constexpr std::string_view separators = ",;|";
    const std::string text = safe_text(raw);
    std::string quoted = "\"";
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
        const std::string_view cell = std::string_view(text).substr(begin, end - begin);
        if (is_formula(cell)) quoted += '\'';
        for (const char c : cell) quoted.append(c == '"' ? 2 : 1, c);
        if (end < text.size()) quoted += text[end];
        begin = end + 1;
    }
    quoted += '"';
    const bool is_plain = quoted.size() == text.size() + 2 && text.find_first_of(",\"") == text.npos;
    return is_plain ? text : quoted;
}

std::string field(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) return exact_text(*number);
    if (const auto* words = std::get_if<std::string>(&cell)) return field(*words);
    return "";
}

/// Returns entry i; an empty cell beyond the end.
Cell value_at(const std::vector<double>& values, std::size_t i) { return i < values.size() ? Cell(values[i]) : Cell(); }

}   // namespace

std::string write_csv(const Table& table) {
    std::string csv;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const Column& column = table.columns[c];
        csv += (c > 0 ? "," : "") + field(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
    }
    csv += '\n';
    for (const auto& row : table.rows) {
        for (std::size_t c = 0; c < table.columns.size(); ++c) csv += (c > 0 ? "," : "") + (c < row.size() ? field(row[c]) : "");
        csv += '\n';
    }
    return csv;
}

Table table_of(const Plot& plot) {
    const bool with_band = std::ranges::any_of(plot.series, [](const Series& series) { return !series.y_low.empty(); });
    const bool with_panels = std::ranges::any_of(plot.series, [](const Series& series) { return !series.panel.empty(); });
    Table table{.id = plot.id};
    if (with_panels) table.columns.push_back({"panel"});
    for (const std::string& name : {std::string("series"), plot.x_label, plot.y_label}) table.columns.push_back({name});
    if (with_band) table.columns.insert(table.columns.end(), {{"low"}, {"high"}});
    for (const Series& series : plot.series) {
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            std::vector<Cell>& row = table.rows.emplace_back();
            if (with_panels) row.emplace_back(series.panel);
            row.insert(row.end(), {series.name, series.x[i], value_at(series.y, i)});
            if (with_band) row.insert(row.end(), {value_at(series.y_low, i), value_at(series.y_high, i)});
        }
    }
    return table;
}

Table table_of(const Map& map) {
    Table table{.id = map.id, .columns = {{"panel"}, {"series"}, {map.x_label}, {map.y_label}, {map.value_label}}};
    for (const Map::Panel& panel : map.panels) {
        for (std::size_t i = 0; i < panel.values.size() && i < map.x.size() * map.y.size(); ++i)
            table.rows.push_back({panel.title, "cells", map.x[i % map.x.size()], map.y[i / map.x.size()], panel.values[i]});
        for (const Series& line : panel.lines)
            for (std::size_t i = 0; i < line.x.size(); ++i)
                table.rows.push_back({panel.title, line.name, line.x[i], value_at(line.y, i), Cell()});
    }
    return table;
}

}   // namespace meshfolio::report
