/// @file
/// The parts of a report as results.json keeps them, where that is not as the document has them; and its words for choices.
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

/// What a value means, where its key does not say so, and the limits of an integer.
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

/// A figure with what is known of its pictures.
struct FigureEntry {
    Figure figure;
    bool is_drawn = false;
    DrawnFigure drawn;
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

/// What a parameter says to programs; the words that are printed stand in `parameters`, under its name.
struct ParameterEntry {
    std::string id, name, unit;
    decltype(Parameter::value) value;
    bool operator==(const ParameterEntry&) const = default;
};

/// A section as results.json keeps it: blocks of a kind together, and their order.
struct SectionEntry {
    Section section;   // without its blocks, checks, parameters and timings
    std::map<std::string, std::string> parameters;
    std::vector<ParameterEntry> parameter_values;
    std::vector<Table> tables;
    std::vector<Plot> plots;
    std::vector<Map> maps;
    std::vector<Diagram> diagrams;
    std::vector<FigureEntry> figures;
    std::vector<NumberedEntry> entries;
    std::vector<BlockEntry> blocks;
    std::vector<CheckEntry> checks;
    std::optional<std::vector<Timing>> timings;   // none: written without them
};

/// Raised whenever a reader of the earlier one would misread what is written; keys that are added do not raise it. Others are refused.
inline constexpr int schema_version = 1;

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
    std::vector<SectionEntry> questions, supporting;
    std::optional<std::vector<Timing>> timings;
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

}   // namespace meshfolio::report
