/// @file
/// The parts of a report as results.json stores them, where they differ from the document, and the names of its enumerators.
#pragma once

#include <array>
#include <concepts>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::report {

template <class Part, class Struct>
concept part_of = std::same_as<std::remove_const_t<Part>, Struct>;

/// The meaning of a value, if its key does not say it, and the limits of an integer.
struct Note {
    Note(const char* words = "", int smallest = std::numeric_limits<int>::min(), int largest = std::numeric_limits<int>::max())
        : meaning(words), least(smallest), most(largest) {}
    const char* meaning;
    int least, most;
    bool is_file = false;   // a path inside the report's folder, or several
};
inline Note file_note() {
    Note note;
    note.is_file = true;
    return note;
}

/// A figure and, once drawn, the data of its pictures.
struct FigureEntry {
    Figure figure;
    bool is_drawn = false;
    DrawnFigure drawn;
};

/// A block as `blocks` stores it: short ones whole, the others by their ids.
struct BlockEntry {
    enum class Kind { heading, paragraph, list, formula, table, plot, map, diagram, figure } kind = Kind::heading;
    std::string title;         // heading
    Text text;                 // paragraph
    std::vector<Text> items;   // list
    std::string name, id;      // formula; id also of a table, plot, map, diagram or figure
};

/// A panel of a map, its values row by row.
struct PanelEntry {
    std::string title;
    std::vector<std::vector<double>> rows;   // a row for each y, a number for each x
    std::vector<Series> lines;
    std::vector<Marker> markers;
};
inline std::vector<PanelEntry> panel_entries(const Map& map) {
    std::vector<PanelEntry> entries;
    for (const Map::Panel& panel : map.panels) {
        PanelEntry& entry = entries.emplace_back(PanelEntry{panel.title, {}, panel.lines, panel.markers});
        for (std::size_t i = 0; i < panel.values.size() && i < map.x.size() * map.y.size(); ++i) {
            if (i % map.x.size() == 0) entry.rows.emplace_back();
            entry.rows.back().push_back(panel.values[i]);
        }
    }
    return entries;
}

/// A column and its id, unique in the report.
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

/// A check and its id, unique in the report.
struct CheckEntry {
    std::string id;
    Check check;
};

/// A parameter for programs; `parameters` has the printed text under its name.
struct ParameterEntry {
    std::string id, name, unit;
    decltype(Parameter::value) value;
    bool operator==(const ParameterEntry&) const = default;
};

/// A section as results.json stores it: blocks of a kind together, and their order.
struct SectionEntry {
    Section section;   // without blocks, checks, parameters and timings
    std::map<std::string, std::string> parameters;
    std::vector<ParameterEntry> parameter_values;
    std::vector<Table> tables;
    std::vector<Plot> plots;
    std::vector<Map> maps;
    std::vector<Diagram> diagrams;
    std::vector<FigureEntry> figures;
    std::vector<BlockEntry> blocks;
    std::vector<CheckEntry> checks;
    std::optional<std::vector<Timing>> timings;   // none: written without them
};

/// Raised when readers of the earlier version would misread a file; added keys do not raise it. read_json() refuses other versions.
inline constexpr int schema_version = 1;

struct MeshDigest {
    std::string file, sha256;
    bool operator==(const MeshDigest&) const = default;
};
/// Returns every input mesh of the sections once, sorted by file and digest.
std::vector<MeshDigest> input_meshes(const std::vector<Section>& sections);

struct ProvenanceEntry {
    Provenance provenance;
    std::vector<MeshDigest> inputs;
};

struct ReportEntry {
    int version = schema_version;
    std::string title, author, course;
    std::vector<OwnPage> pages;
    ProvenanceEntry provenance;
    std::vector<SectionEntry> questions, supporting;
    std::optional<std::vector<Timing>> timings;
};

// ---- names of enumerators -----------------------------------------------------------------------------------------------

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
inline constexpr std::array<const char*, 9> names_of(BlockEntry::Kind) {
    return {"heading", "paragraph", "list", "formula", "table", "plot", "map", "diagram", "figure"};
}

}   // namespace meshfolio::report
