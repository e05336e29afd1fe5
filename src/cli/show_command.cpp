// Tables, plots, maps and figures of a finished report, for programs.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "cli/commands.h"
#include "run/console.h"
#include "run/stored_report.h"

namespace meshfolio::cli {

namespace {

using report::Cell;
using report::Table;

struct ShowFlags {
    std::string report, id;
    std::vector<std::string> cell;   // a column, and conditions KEY=VALUE
};

/// Throws a UsageError that suggests known names, unless there are none.
[[noreturn]] void refuse_name(const std::string& problem, const std::string& word, const std::vector<std::string>& known) {
    throw UsageError(problem, suggestion(word, known) + (known.empty() ? "" : "it has " + first_of_many(known)));
}

/// Returns the tables of a report, and the data of its plots and maps as tables, by id.
std::map<std::string, Table> tables_of(const report::Document& document) {
    std::map<std::string, Table> tables;
    for (const report::Section& section : document.sections) {
        for (const report::Block& block : section.blocks) {
            if (const auto* table = std::get_if<Table>(&block)) tables[table->id] = *table;
            if (const auto* plot = std::get_if<report::Plot>(&block)) tables[plot->id] = table_of(*plot);
            if (const auto* map = std::get_if<report::Map>(&block)) tables[map->id] = table_of(*map);
        }
    }
    return tables;
}

/// Returns the heads of the columns in CSV: "rms [% of box]".
std::vector<std::string> heads_of(const Table& table) {
    std::vector<std::string> heads;
    for (const report::Column& column : table.columns) heads.push_back(column.name + (column.unit.empty() ? "" : " [" + column.unit + "]"));
    return heads;
}

/// Returns the number of the column with this head, name, or id, which has letters and digits of the name alone; −1: none.
int column_named(const Table& table, const std::string& word) {
    const std::vector<std::string> heads = heads_of(table), ids = report::column_ids(table);
    const std::string id = report::column_ids({.id = table.id, .columns = {{.name = word}}}).front();
    const auto first = [&](auto is_it) {
        for (std::size_t c = 0; c < ids.size(); ++c)
            if (is_it(c)) return static_cast<int>(c);
        return -1;
    };
    if (const int column = first([&](std::size_t c) { return heads[c] == word; }); column >= 0) return column;
    if (const int column = first([&](std::size_t c) { return table.columns[c].name == word; }); column >= 0) return column;
    return first([&](std::size_t c) { return ids[c] == id; });
}

int known_column(const Table& table, const std::string& word) {
    const int column = column_named(table, word);
    if (column < 0) refuse_name(in_quotes(table.id) + " has no column " + in_quotes(word), word, heads_of(table));
    return column;
}

/// Returns a cell as text; "" if it is undefined.
std::string cell_text(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) return exact_text(*number);
    const auto* words = std::get_if<std::string>(&cell);
    return words != nullptr ? printable(*words) : "";
}

/// Returns the table with the rows that have `value`, a number or a text, in this column.
Table rows_where(Table table, int column, const std::string& value) {
    const auto number = parse_number(value);
    std::vector<std::string> known;
    std::vector<std::vector<Cell>> rows;
    for (const std::vector<Cell>& row : table.rows) {
        const Cell& cell = row[static_cast<std::size_t>(column)];
        const auto* measured = std::get_if<double>(&cell);
        if (measured != nullptr && number ? *measured == *number : cell_text(cell) == value) rows.push_back(row);
        if (std::ranges::find(known, cell_text(cell)) == known.end()) known.push_back(cell_text(cell));
    }
    const std::string& name = table.columns[static_cast<std::size_t>(column)].name;
    if (rows.empty()) refuse_name("no row of " + in_quotes(table.id) + " has " + in_quotes(value) + " as " + in_quotes(name), value, known);
    table.rows = std::move(rows);
    return table;
}

/// Returns the rows that meet the conditions: all columns or one of them as CSV, or the value alone if it is one column of one row.
std::string part_of(Table table, const std::vector<std::string>& words) {
    std::optional<std::size_t> shown;
    bool has_conditions = false;
    for (const std::string& word : words) {
        std::size_t sign = word.find('=');   // the first behind a name, or else the first: names may have others
        for (std::size_t next = sign; next != std::string::npos; next = word.find('=', next + 1)) {
            if (column_named(table, word.substr(0, next)) < 0) continue;
            sign = next;
            break;
        }
        const bool is_column = !shown && (sign == std::string::npos || column_named(table, word) >= 0);
        if (is_column) {
            shown = static_cast<std::size_t>(known_column(table, word));
        } else if (sign == std::string::npos) {
            throw UsageError(in_quotes(word) + " is a second column", "name one column, and write conditions as KEY=VALUE");
        } else {
            table = rows_where(std::move(table), known_column(table, word.substr(0, sign)), word.substr(sign + 1));
            has_conditions = true;
        }
    }
    if (!shown) return write_csv(table);
    if (table.rows.size() == 1) {
        const std::string text = cell_text(table.rows[0][*shown]);
        if (text.empty()) warn("this cell of " + in_quotes(table.id) + " is undefined");
        return text + "\n";
    }
    if (has_conditions) {
        std::vector<std::string> keys;   // that tell the rows apart
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            if (std::ranges::any_of(table.rows, [&](const auto& row) { return row[c] != table.rows[0][c]; }))
                keys.push_back(heads_of(table)[c]);
        throw UsageError(std::to_string(table.rows.size()) + " rows of " + in_quotes(table.id) + " meet these conditions",
                         "add KEY=VALUE; they differ in " + first_of_many(keys));
    }
    table.columns = {table.columns[*shown]};
    for (std::vector<Cell>& row : table.rows) row = {row[*shown]};
    return write_csv(table);
}

ExitCode run_show(const ShowFlags& options) {
    const report::ReadReport report = read_report(options.report);
    const std::map<std::string, Table> tables = tables_of(report.document);
    if (const auto table = tables.find(options.id); table != tables.end()) {
        print(part_of(table->second, options.cell));
        return ExitCode::ok;
    }
    const auto figure = report.figures.find(options.id);
    if (figure == report.figures.end()) {
        std::vector<std::string> known;
        for (const auto& [id, table] : tables) known.push_back(id);
        for (const auto& [id, drawn] : report.figures) known.push_back(id);
        refuse_name(options.report + " has no table, plot or figure " + in_quotes(options.id), options.id, known);
    }
    if (!options.cell.empty())
        throw UsageError(in_quotes(options.id) + " is a figure, which has no columns", "leave out the words after it");
    const std::filesystem::path given = options.report;
    const auto file = (std::filesystem::is_directory(given) ? given : given.parent_path()) / figure->second.sheet;
    if (!may_be_there(file)) throw InputError({file.string()}, "is not there", "restore it beside results.json, or make the report anew");
    print_path(file);
    return ExitCode::ok;
}

}   // namespace

Command show_command(CLI::App& parent) {
    const auto options = std::make_shared<ShowFlags>();
    CommandOptions app(parent, "show", "A table of a report, one cell of it, or the path of a figure");
    app.required("REPORT", options->report, "folder of a report, or its results.json");
    app.required("ID", options->id, "of a table, plot or map, printed as CSV with all digits; of a figure, whose path is printed");
    app.texts("CELL", options->cell, "COLUMN: one column alone; KEY=VALUE, several times: rows with this value in the column KEY");
    app.footer(
        "A column of one row is printed as a value. Columns may be written as in the report or with hyphens: mean-normal-angle.\n"
        "Example: meshfolio show out q3_errors_l2 mixed surface=sphere triangulation=regular");
    return {app, [options] { return run_show(*options); }};
}

}   // namespace meshfolio::cli
