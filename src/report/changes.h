/// @file
/// The changes between two reports, as plain data.
#pragma once

#include <string>
#include <vector>

#include "report/document.h"

namespace meshfolio::report {

/// One change. `before` or `after` is empty if there was nothing, or is nothing any more.
struct Change {
    /// In the order of reading. `presence`: a table, plot, map, figure, mesh, row or column that came or went.
    enum class Kind { program, setting, input, section, check, number, presence, picture, mesh } kind = Kind::program;
    std::string section = {};   // "q3"; empty: the report as a whole
    std::string id = {};        // of a check, table or picture; name of a setting; path of a mesh
    std::string row = {};       // of a number: the key cells of its row, "sphere, regular"
    std::string column = {};    // of a number, with its unit; of a presence: "table", "row", …
    std::string before = {}, after = {};
    /// For the order, largest first: relative change of a number, share of the pixels of a picture, distance of meshes over the box
    /// diagonal; of a check 3 if it fails now, 2 if it is gone, 1 if it is undecided, else 0.
    double size = 0;
    bool operator==(const Change&) const = default;
};

/// The names of the kinds for people and files: "program", "setting", …
const char* name_of(Change::Kind kind);

/// The numbers of parts that both reports have.
struct ComparedParts {
    int checks = 0, numbers = 0, tables = 0, pictures = 0, meshes = 0;
};

inline constexpr double default_tolerance = 1e-9;   // relative

/// Returns the changes between two documents, in the order of Change::Kind, the largest changes of a kind first, undefined ones last.
/// Sections, checks, tables, plots and maps are matched by their ids, columns by their names, rows by the first cells that distinguish
/// them. Numbers a and b differ if |a − b| > tolerance max(|a|, |b|), or if one of them is undefined.
/// @param compared  counts the common parts
std::vector<Change> changes_between(const Document& before, const Document& after, double tolerance, ComparedParts& compared);

/// Sorts changes as changes_between() does.
void sort_changes(std::vector<Change>& changes);

}   // namespace meshfolio::report
