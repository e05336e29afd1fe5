// results.json, for programs. Its schema is templates/results.schema.json.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "report/numbering.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

using Json = nlohmann::ordered_json;   // keys in the order they are written here

constexpr int schema_version = 1;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json numbers(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double x : values) list.push_back(number(x));
    return list;
}

Json cell_json(const Cell& cell) {
    if (const auto* x = std::get_if<double>(&cell)) return number(*x);
    if (const auto* words = std::get_if<std::string>(&cell)) return *words;
    return nullptr;
}

Json table_json(const Table& table) {
    Json columns = Json::array(), rows = Json::array();
    for (const Column& column : table.columns) columns.push_back({{"name", column.name}, {"unit", column.unit}});
    for (const auto& row : table.rows) {
        Json cells = Json::array();
        for (const Cell& cell : row) cells.push_back(cell_json(cell));
        rows.push_back(std::move(cells));
    }
    return {{"id", table.id}, {"caption", table.caption}, {"file", "tables/" + table.id + ".csv"}, {"columns", columns}, {"rows", rows}};
}

Json series_json(const Series& series) {
    Json json = {{"name", series.name}, {"x", numbers(series.x)}, {"y", numbers(series.y)}};
    if (!series.y_low.empty()) {
        json["y_low"] = numbers(series.y_low);
        json["y_high"] = numbers(series.y_high);
    }
    return json;
}

Json marker_json(const Marker& marker) { return {{"x", number(marker.x)}, {"y", number(marker.y)}, {"label", marker.label}}; }

Json plot_json(const Plot& plot) {
    Json series = Json::array(), markers = Json::array(), lines = Json::array();
    for (const Series& s : plot.series) series.push_back(series_json(s));
    for (const Marker& m : plot.markers) markers.push_back(marker_json(m));
    for (const auto& line : plot.vertical_lines) lines.push_back({{"x", number(line.x)}, {"label", line.label}});
    return {{"id", plot.id},           {"caption", plot.caption}, {"alt", plot.alt},        {"file", "tables/" + plot.id + ".csv"},
            {"x_label", plot.x_label}, {"y_label", plot.y_label}, {"log_x", plot.log_x},    {"log_y", plot.log_y},
            {"series", series},        {"markers", markers},      {"vertical_lines", lines}};
}

/// The values of a panel as rows, one a y.
Json panel_json(const Map& map, const Map::Panel& panel) {
    Json rows = Json::array(), lines = Json::array(), markers = Json::array();
    for (std::size_t i = 0; i < panel.values.size() && i < map.x.size() * map.y.size(); ++i) {
        if (i % map.x.size() == 0) rows.push_back(Json::array());
        rows.back().push_back(number(panel.values[i]));
    }
    for (const Series& line : panel.lines) lines.push_back(series_json(line));
    for (const Marker& marker : panel.markers) markers.push_back(marker_json(marker));
    return {{"title", panel.title}, {"values", rows}, {"lines", lines}, {"markers", markers}};
}

Json map_json(const Map& map) {
    Json panels = Json::array();
    for (const Map::Panel& panel : map.panels) panels.push_back(panel_json(map, panel));
    return {{"id", map.id},
            {"caption", map.caption},
            {"alt", map.alt},
            {"file", "tables/" + map.id + ".csv"},
            {"x_label", map.x_label},
            {"y_label", map.y_label},
            {"value_label", map.value_label},
            {"log_x", map.log_x},
            {"log_y", map.log_y},
            {"log_values", map.log_values},
            {"undefined", map.undefined},
            {"x", numbers(map.x)},
            {"y", numbers(map.y)},
            {"panels", panels}};
}

Json figure_json(const Figure& figure, const DrawnFigures& drawn) {
    Json views = Json::array();
    Json sheet;   // null: not drawn
    if (const auto it = drawn.find(figure.id); it != drawn.end()) {
        sheet = it->second.sheet;
        for (const auto& [label, file] : it->second.views) views.push_back({{"label", label}, {"file", file}});
    }
    return {{"id", figure.id}, {"caption", figure.caption}, {"alt", figure.alt}, {"sheet", sheet}, {"views", views}};
}

void append_entries(const EntryList& list, Json& entries) {
    for (const Entry& entry : list.entries) {
        Json paragraphs = Json::array();
        for (const Text& paragraph : entry.paragraphs) paragraphs.push_back(plain(paragraph));
        entries.push_back({{"id", entry.id}, {"kind", list.kind}, {"title", plain(entry.title)}, {"paragraphs", paragraphs}});
    }
}

Json check_json(const Check& check) {
    constexpr const char* kind[] = {"near", "at_most", "at_least"};
    Json json = {{"name", check.name},
                 {"kind", kind[static_cast<int>(check.kind)]},
                 {"expected", number(check.expected)},
                 {"measured", number(check.measured)},
                 {"tolerance", number(check.tolerance)},
                 {"passed", check.passed}};
    if (!check.note.empty()) json["note"] = check.note;
    return json;
}

Json input_json(const Input& input) {
    return {{"role", input.role},     {"asked", input.asked},       {"file", input.file},          {"stand_in", input.stand_in},
            {"sha256", input.sha256}, {"vertices", input.vertices}, {"triangles", input.triangles}};
}

Json code_json(const CodeReference& code) {
    Json json = {{"function", code.function}, {"file", code.file}, {"purpose", code.purpose}};
    if (code.line > 0) json["line"] = code.line;
    return json;
}

Json timings_json(const std::vector<Timing>& timings) {
    Json list = Json::array();
    for (const Timing& timing : timings) list.push_back({{"what", timing.what}, {"seconds", number(timing.seconds)}});
    return list;
}

template <class Item, class Convert>
Json list_of(const std::vector<Item>& items, Convert convert) {
    Json list = Json::array();
    for (const Item& item : items) list.push_back(convert(item));
    return list;
}

Json section_json(const Section& section, const DrawnFigures& drawn, const WriteOptions& options) {
    constexpr const char* status[] = {"ok", "failed", "skipped"};
    Json tables = Json::array(), plots = Json::array(), maps = Json::array(), figures = Json::array(), entries = Json::array();
    for (const Block& block : section.blocks) {
        if (const auto* table = std::get_if<Table>(&block)) tables.push_back(table_json(*table));
        if (const auto* plot = std::get_if<Plot>(&block)) plots.push_back(plot_json(*plot));
        if (const auto* map = std::get_if<Map>(&block)) maps.push_back(map_json(*map));
        if (const auto* figure = std::get_if<Figure>(&block)) figures.push_back(figure_json(*figure, drawn));
        if (const auto* list = std::get_if<EntryList>(&block)) append_entries(*list, entries);
    }
    Json json = {{"id", section.id},
                 {"title", section.title},
                 {"asked", section.asked},
                 {"status", status[static_cast<int>(section.status)]},
                 {"extent", section.extent}};
    if (section.status == Status::failed) json["failure"] = section.failure;
    json["inputs"] = list_of(section.inputs, input_json);
    json["parameters"] = section.parameters;
    json["code"] = list_of(section.code, code_json);
    json["tables"] = std::move(tables);
    json["plots"] = std::move(plots);
    json["maps"] = std::move(maps);
    json["figures"] = std::move(figures);
    if (!entries.empty()) json["entries"] = std::move(entries);
    json["checks"] = list_of(section.checks, check_json);
    json["findings"] = list_of(section.findings, [](const Finding& f) { return Json{{"text", plain(f.text)}, {"weight", f.weight}}; });
    json["warnings"] = section.warnings;
    json["output_meshes"] = section.output_meshes;
    if (options.timings) json["timings"] = timings_json(section.timings);
    return json;
}

/// Every input mesh once, by name and content.
Json input_meshes(const Document& document) {
    std::set<std::pair<std::string, std::string>> meshes;
    for (const Section& section : document.sections) {
        for (const Input& input : section.inputs) meshes.emplace(input.file, input.sha256);
    }
    Json list = Json::array();
    for (const auto& [file, sha256] : meshes) list.push_back({{"file", file}, {"sha256", sha256}});
    return list;
}

Json provenance_json(const Document& document) {
    const Provenance& p = document.provenance;
    return {{"program", "meshfolio"},          {"version", p.version},     {"commit", p.commit},     {"compiler", p.compiler},
            {"build_type", p.build_type},      {"libraries", p.libraries}, {"settings", p.settings}, {"seed", p.seed},
            {"inputs", input_meshes(document)}};
}

}   // namespace

std::string write_json(const Document& document, const DrawnFigures& figures, const WriteOptions& options) {
    Json json = {{"schema_version", schema_version},
                 {"title", document.title},
                 {"author", document.author},
                 {"course", document.course},
                 {"provenance", provenance_json(document)}};
    json["questions"] = json["supporting"] = Json::array();
    for (const Section& section : document.sections)
        json[is_question(section) ? "questions" : "supporting"].push_back(section_json(section, figures, options));
    if (options.timings) json["timings"] = timings_json(document.timings);
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}   // namespace meshfolio::report
