/// @file
/// Which keys the parts of a report have in results.json: each is described once, for the writer, the reader and the schema. `Fields` is a
/// FieldWriter, FieldReader or FieldSchema (json_writer.h, json_reader.h, json_schema.cpp); a note at the end is for the schema:
///   fields(key, value)                      always there
///   fields.optional(key, value, fallback)   left out where it is the fallback
///   fields.only_if(condition, key, value)   there where the condition holds
///   fields.derived(key, f)                  follows from the other values: written for programs, checked when read
#pragma once

#include <array>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "report/document.h"

namespace meshfolio::report {

template <class Part, class Struct>
concept part_of = std::same_as<std::remove_const_t<Part>, Struct>;

/// What a value means, where its key does not say so, and the limits of an integer.
struct Note {
    Note(const char* words = "", int smallest = std::numeric_limits<int>::min(), int largest = std::numeric_limits<int>::max())
        : meaning(words), least(smallest), most(largest) {}
    const char* meaning;
    int least, most;
};

/// A figure with what is known of its pictures.
struct FigureEntry {
    Figure figure;
    bool is_drawn = false;
    DrawnFigure drawn;
};

/// The picture of the first page, likewise.
struct CoverEntry {
    FigureEntry drawn;
    std::string section;
    bool turnable = false;
    double worth = 0;
};

/// One entry of an EntryList, with the kind it shares with the others.
struct NumberedEntry {
    std::string kind;
    Entry entry;
};

/// A block as it stands in `blocks`: short ones whole, the others by their ids.
struct BlockEntry {
    enum class Kind { heading, paragraph, list, formula, table, plot, map, diagram, figure, entries } kind = Kind::heading;
    std::string title;         // heading
    Text text;                 // paragraph
    std::vector<Text> items;   // list
    std::string name, id;      // formula; id also of a table, plot, map, diagram or figure
    std::vector<std::string> ids;
};

/// A column with the id it goes by in its report.
struct ColumnEntry {
    std::string id;
    Column column;
};
inline std::vector<ColumnEntry> column_entries(const Table& table) {
    const std::vector<std::string> ids = column_ids(table);
    std::vector<ColumnEntry> entries;
    for (std::size_t i = 0; i < ids.size(); ++i) entries.push_back({ids[i], table.columns[i]});
    return entries;
}

/// A check with the id it goes by in its report.
struct CheckEntry {
    std::string id;
    Check check;
};

/// A section as results.json keeps it: blocks of a kind together, and their order.
struct SectionEntry {
    Section section;   // without its blocks and checks
    std::vector<Table> tables;
    std::vector<Plot> plots;
    std::vector<Map> maps;
    std::vector<Diagram> diagrams;
    std::vector<FigureEntry> figures;
    std::vector<NumberedEntry> entries;
    std::vector<BlockEntry> blocks;
    std::vector<CheckEntry> checks;
    bool with_timings = true;
};

// ---- words for choices --------------------------------------------------------------------------------------------------

inline constexpr std::array<const char*, 3> names_of(Column::Best) { return {"none", "smallest", "largest"}; }
inline constexpr std::array<const char*, 4> names_of(Column::Rounding) { return {"nearest", "down", "up", "tenths"}; }
inline constexpr std::array<const char*, 4> names_of(Series::Style) { return {"line", "points", "line_and_points", "dashed"}; }
inline constexpr std::array<const char*, 2> names_of(Map::Colours) { return {"sequential", "diverging"}; }
inline constexpr std::array<const char*, 6> names_of(Diagram::Style) { return {"line", "thin", "dashed", "area", "accent", "accent_area"}; }
inline constexpr std::array<const char*, 9> names_of(Diagram::Side) {
    return {"centre", "above", "below", "left", "right", "above_left", "above_right", "below_left", "below_right"};
}
inline constexpr std::array<const char*, 3> names_of(Check::Kind) { return {"near", "at_most", "at_least"}; }
inline constexpr std::array<const char*, 3> names_of(Check::Status) { return {"passed", "failed", "undecided"}; }
inline constexpr std::array<const char*, 3> names_of(Status) { return {"ok", "failed", "skipped"}; }
inline constexpr std::array<const char*, 6> names_of(Run::Kind) { return {"plain", "strong", "emphasis", "code", "math", "reference"}; }
inline constexpr std::array<const char*, 10> names_of(BlockEntry::Kind) {
    return {"heading", "paragraph", "list", "formula", "table", "plot", "map", "diagram", "figure", "entries"};
}

// ---- tables -------------------------------------------------------------------------------------------------------------

inline constexpr int most_digits = 17;   // a double has no more
inline std::string table_file(const std::string& id) { return "tables/" + id + ".csv"; }

template <class Fields, class Part>
requires part_of<Part, Column::Heat> || part_of<Part, Map::Range>
void describe(Fields& fields, Part& range) {
    fields("low", range.low);
    fields("high", range.high);
}

template <class Fields>
void describe(Fields& fields, part_of<Column> auto& column) {
    const Column fallback;
    fields("name", column.name);
    fields("unit", column.unit);
    fields("digits", column.digits, {"significant, for people", 1, most_digits});
    fields.optional("best", column.best, fallback.best, "which value is marked");
    fields.optional("rounding", column.rounding, fallback.rounding, "of people's digits");
    fields.optional("heat", column.heat, "cells are shaded between these");
    fields.optional("filter", column.filter, fallback.filter, "readers may choose one of its values");
    fields.optional("reference", column.reference, fallback.reference, "its texts are ids");
}

template <class Fields>
void describe(Fields& fields, part_of<ColumnEntry> auto& entry) {
    fields.optional("id", entry.id, {});   // earlier files have none
    describe(fields, entry.column);
}

template <class Fields>
void describe(Fields& fields, part_of<Table> auto& table) {
    fields("id", table.id);
    fields("caption", table.caption);
    fields.derived("file", [&] { return table_file(table.id); });
    fields.optional("sortable", table.sortable, false, "readers of the page may sort it");
    std::vector<ColumnEntry> columns = column_entries(table);
    fields("columns", columns);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(table)>>) {   // it is read
        table.columns.clear();
        for (ColumnEntry& entry : columns) table.columns.push_back(std::move(entry.column));
    }
    fields("rows", table.rows);
}

// ---- plots and maps -----------------------------------------------------------------------------------------------------

template <class Fields>
void describe(Fields& fields, part_of<Series> auto& series) {
    fields("name", series.name);
    fields.optional("style", series.style, Series::Style::line);
    fields.optional("color", series.color, -1, {"which of six; absent: that of its place", 0});
    fields.optional("pattern", series.pattern, -1, {"which of seven dashes and shapes of points; absent: that of its place", 0});
    fields.optional("panel", series.panel, {}, "those of one panel share a small plot; absent: one plot for all");
    fields("x", series.x);
    fields("y", series.y);
    fields.optional("y_low", series.y_low, {});
    fields.optional("y_high", series.y_high, {});
}

template <class Fields>
void describe(Fields& fields, part_of<Marker> auto& marker) {
    fields("x", marker.x);
    fields("y", marker.y);
    fields("label", marker.label);
    fields.optional("panel", marker.panel, {});
}

template <class Fields>
void describe(Fields& fields, part_of<Plot::VerticalLine> auto& line) {
    fields("x", line.x);
    fields("label", line.label);
}

/// What begins a plot as well as a map.
template <class Fields>
void describe_drawing(Fields& fields, auto& drawing) {
    fields("id", drawing.id);
    fields("caption", drawing.caption);
    fields("alt", drawing.alt);
    fields.derived("file", [&] { return table_file(drawing.id); });
    fields("x_label", drawing.x_label);
    fields("y_label", drawing.y_label);
}

template <class Fields>
void describe(Fields& fields, part_of<Plot> auto& plot) {
    describe_drawing(fields, plot);
    fields("log_x", plot.log_x);
    fields("log_y", plot.log_y);
    fields("series", plot.series);
    fields("markers", plot.markers);
    fields("vertical_lines", plot.vertical_lines);
}

template <class Fields>
void describe(Fields& fields, part_of<Map> auto& map) {
    const Map fallback;
    describe_drawing(fields, map);
    fields("value_label", map.value_label);
    fields("log_x", map.log_x);
    fields("log_y", map.log_y);
    fields("log_values", map.log_values);
    fields.optional("colours", map.colours, fallback.colours);
    fields.optional("middle", map.middle, fallback.middle, "where a diverging map is palest");
    fields.optional("range", map.range, "of the colours; absent: all that is finite");
    fields("undefined", map.undefined, "what cells without a value are");
    fields("x", map.x);
    fields("y", map.y);
    fields.each("panels", map.panels, [&](auto& panel_fields, auto& panel) {
        panel_fields("title", panel.title);
        panel_fields.rows("values", panel.values, map.x.size(), map.y.size(), "one row a y, one number an x");
        panel_fields("lines", panel.lines);
        panel_fields("markers", panel.markers);
    });
}

// ---- diagrams -----------------------------------------------------------------------------------------------------------

template <class Fields>
void describe(Fields& fields, part_of<Diagram::Path> auto& path) {
    fields.optional("style", path.style, Diagram::Style::line);
    fields.optional("closed", path.closed, false);
    fields.optional("arrow", path.arrow, false, "a head at its last point");
    fields("x", path.x);
    fields("y", path.y);
}

template <class Fields>
void describe(Fields& fields, part_of<Diagram::Label> auto& label) {
    fields("x", label.x);
    fields("y", label.y);
    fields("words", label.words);
    fields.optional("side", label.side, Diagram::Side::above, "of its point, on which it stands");
    fields.optional("dot", label.dot, false, "the point is marked");
    fields.optional("accent", label.accent, false);
}

template <class Fields>
void describe(Fields& fields, part_of<Diagram::Panel> auto& panel) {
    fields("title", panel.title);
    fields("paths", panel.paths);
    fields("labels", panel.labels);
}

template <class Fields>
void describe(Fields& fields, part_of<Diagram> auto& diagram) {
    fields("id", diagram.id);
    fields("caption", diagram.caption);
    fields("alt", diagram.alt);
    fields("panels", diagram.panels);
}

// ---- figures ------------------------------------------------------------------------------------------------------------

template <class Fields>
void describe(Fields& fields, part_of<DrawnPicture> auto& picture) {
    fields.optional("view", picture.view, {}, "the direction it is seen from; absent: three quarters");
    fields("left", picture.left, {"in the sheet [pixels]", 0});
    fields("top", picture.top, {"", 0});
    fields("width", picture.width, {"", 1});
    fields("height", picture.height, {"", 1});
    fields.file_if_any("file", picture.file);
}

template <class Fields>
void describe(Fields& fields, part_of<DrawnPanel> auto& panel) {
    fields("label", panel.label);
    fields("pictures", panel.pictures, "none: an empty cell of a matrix, and the label says why");
}

template <class Fields>
void describe(Fields& fields, part_of<Legend> auto& legend) {
    fields("quantity", legend.quantity);
    fields("unit", legend.unit);
    fields("low", legend.low);
    fields("high", legend.high);
    fields("colours", legend.colours, "evenly from low to high");
    fields.optional("clipped_below", legend.clipped_below, 0, "share of the values");
    fields.optional("clipped_above", legend.clipped_above, 0, "share of the values");
    fields.optional("undefined", legend.undefined, {}, "colour of what has no value; absent: everything has one");
    fields.optional("histogram", legend.histogram, {}, "share of the values in equal bins");
    fields.optional("log", legend.log, false, "equal ratios are equally far apart");
}

template <class Fields>
void describe(Fields& fields, part_of<DrawnModel> auto& model) {
    fields.optional("label", model.label, {});
    fields.file("file", model.file);
    fields.optional("quantity", model.quantity, {}, "of the values at the vertices, with its unit");
}

template <class Fields>
void describe(Fields& fields, part_of<FigureEntry> auto& entry) {
    fields("id", entry.figure.id);
    fields("caption", entry.figure.caption);
    fields("alt", entry.figure.alt);
    fields.file_or_null("sheet", entry.drawn.sheet, entry.is_drawn, "null: could not be drawn");
    const DrawnFigure fallback;
    fields.optional("in_a_line", entry.drawn.in_a_line, fallback.in_a_line, "panels beside each other");
    fields.optional("columns", entry.drawn.columns, {}, "heads of a matrix, whose panels are given row by row");
    fields.optional("rows", entry.drawn.rows, {});
    fields.optional("panels", entry.drawn.panels, {}, "meshes, and where their pictures are in the sheet");
    fields.optional("legend", entry.drawn.legend, "what the colours mean");
    fields.optional("models", entry.drawn.models, {}, "meshes that readers of the page can turn");
}

template <class Fields>
void describe(Fields& fields, part_of<CoverEntry> auto& cover) {
    describe(fields, cover.drawn);
    fields.optional("section", cover.section, {}, "whose figure it is");
    fields.optional("turnable", cover.turnable, false, "readers of the page can turn its mesh");
    fields.optional("worth", cover.worth, 0, "1 + the magnitudes of the angle deficits of its mesh [rad]; the largest is taken");
}

// ---- what a section is made of ------------------------------------------------------------------------------------------

template <class Fields>
void describe(Fields& fields, part_of<NumberedEntry> auto& numbered) {
    const auto plain_paragraphs = [&] {
        std::vector<std::string> words;
        for (const Text& paragraph : numbered.entry.paragraphs) words.push_back(plain(paragraph));
        return words;
    };
    fields("id", numbered.entry.id);
    fields("kind", numbered.kind, "what it is called by: \"Claim\"");
    fields("title_runs", numbered.entry.title);
    fields("paragraph_runs", numbered.entry.paragraphs);
    fields.derived("title", [&] { return plain(numbered.entry.title); });
    fields.derived("paragraphs", plain_paragraphs);
}

template <class Fields>
void describe(Fields& fields, part_of<BlockEntry> auto& block) {
    fields("kind", block.kind);
    switch (block.kind) {
        case BlockEntry::Kind::heading:
            return fields("title", block.title);
        case BlockEntry::Kind::paragraph:
            return fields("text", block.text);
        case BlockEntry::Kind::list:
            return fields("items", block.items);
        case BlockEntry::Kind::formula:
            fields("name", block.name, "in formulas.json");
            return fields.optional("id", block.id, {});
        case BlockEntry::Kind::entries:
            fields("title", block.title);
            return fields("ids", block.ids);
        default:
            return fields("id", block.id);
    }
}

template <class Fields>
void describe(Fields& fields, part_of<Check> auto& check) {
    fields("name", check.name);
    fields("kind", check.kind);
    fields("expected", check.expected);
    fields("measured", check.measured);
    fields("tolerance", check.tolerance);
    fields("status", check.status);
    const auto passed = [&] { return check.status == Check::Status::undecided ? std::nullopt : std::optional(check.passed()); };
    fields.derived("passed", passed, "null: undecided");
    fields.optional("note", check.note, {});
}

template <class Fields>
void describe(Fields& fields, part_of<CheckEntry> auto& entry) {
    fields.optional("id", entry.id, {});   // earlier files have none
    describe(fields, entry.check);
}

template <class Fields>
void describe(Fields& fields, part_of<Input> auto& input) {
    fields("role", input.role);
    fields("asked", input.asked, "the assignment's path; empty: no one asked for this mesh");
    fields("file", input.file);
    fields("stand_in", input.stand_in, "a bundled mesh in place of the one asked for");
    fields("sha256", input.sha256);
    fields("vertices", input.vertices, {"", 0});
    fields("triangles", input.triangles, {"", 0});
}

template <class Fields>
void describe(Fields& fields, part_of<CodeReference> auto& code) {
    fields("function", code.function);
    fields("file", code.file);
    fields("purpose", code.purpose);
    fields.optional("line", code.line, 0, {"of its definition in src.txt; absent where src.txt has none", 1});
}

template <class Fields>
void describe(Fields& fields, part_of<Timing> auto& timing) {
    fields("what", timing.what);
    fields("seconds", timing.seconds);
}

inline constexpr const char* timings_note = "absent when the report was made without timings; the only part that differs from run to run";

template <class Fields>
void describe(Fields& fields, part_of<SectionEntry> auto& entry) {
    auto& section = entry.section;
    fields("id", section.id);
    fields("title", section.title);
    fields("asked", section.asked);
    fields("status", section.status);
    fields("extent", section.extent);
    fields.optional("answer", section.answer, {}, "in one sentence");
    fields.only_if(section.status == Status::failed, "failure", section.failure, "why, for status failed");
    fields("inputs", section.inputs);
    fields("parameters", section.parameters);
    fields("code", section.code);
    fields("blocks", entry.blocks, "what is read, in order: each list below from its beginning");
    fields.optional("appendix_from", section.appendix_from, -1,
                    {"how many of them stand in the report; the appendix has the others; absent: none", 0});
    fields("tables", entry.tables);
    fields("plots", entry.plots);
    fields("maps", entry.maps, "values over a plane, in panels on common axes");
    fields.optional("diagrams", entry.diagrams, {}, "the geometry behind a formula, y upwards; absent where there are none");
    fields("figures", entry.figures);
    fields.optional("entries", entry.entries, {}, "numbered texts that tables refer to by their ids; absent where there are none");
    fields(
        "checks", entry.checks,
        "near: |measured - expected| <= tolerance; at_most: measured <= expected + tolerance; at_least: measured >= expected - tolerance; "
        "undecided: the number says nothing about what is checked, for the reason in the note, and is no failure");
    fields("warnings", section.warnings);
    fields.files("output_meshes", section.output_meshes);
    fields.if_there("timings", section.timings, entry.with_timings, timings_note);
}

/// Raised whenever a reader of the earlier one would misread what is written; keys that are added do not raise it.
inline constexpr int schema_version = 4;

struct MeshDigest {
    std::string file, sha256;
    bool operator==(const MeshDigest&) const = default;
};
/// Every input mesh once, by name and content.
std::vector<MeshDigest> input_meshes(const std::vector<Section>& sections);

struct ProvenanceEntry {
    Provenance provenance;
    std::vector<MeshDigest> inputs;
};

struct ReportEntry {
    int version = schema_version;
    std::string title, author, course;
    ProvenanceEntry provenance;
    std::optional<CoverEntry> cover;
    std::vector<SectionEntry> questions, supporting;
    bool with_timings = true;
    std::vector<Timing> timings;
};

template <class Fields>
void describe(Fields& fields, part_of<MeshDigest> auto& mesh) {
    fields("file", mesh.file);
    fields("sha256", mesh.sha256);
}

template <class Fields>
void describe(Fields& fields, part_of<ProvenanceEntry> auto& entry) {
    auto& provenance = entry.provenance;
    fields.derived("program", [] { return "meshfolio"; });
    fields("version", provenance.version);
    fields("commit", provenance.commit);
    fields("compiler", provenance.compiler);
    fields("build_type", provenance.build_type);
    fields("libraries", provenance.libraries);
    fields("settings", provenance.settings);
    fields("seed", provenance.seed, "64 bits without sign");
    fields("inputs", entry.inputs);
}

template <class Fields>
void describe(Fields& fields, part_of<ReportEntry> auto& report) {
    fields("schema_version", report.version, {"", schema_version, schema_version});
    fields("title", report.title);
    fields("author", report.author);
    fields("course", report.course);
    fields("provenance", report.provenance);
    fields.optional("cover", report.cover, "the picture of the first page");
    fields("questions", report.questions);
    fields("supporting", report.supporting);
    fields.if_there("timings", report.timings, report.with_timings, timings_note);
}

}   // namespace meshfolio::report
