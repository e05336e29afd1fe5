/// @file
/// The tables of tests/reference: what an independent program in long double found on the bundled and the shared meshes.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/file_bytes.h"
#include "shared_meshes.h"
#include "source_dir.h"

namespace meshfolio::testing {

/// One row: column name to entry.
using TableRow = std::map<std::string, std::string>;

inline double number(const TableRow& row, const std::string& column) {
    const std::string& entry = row.at(column);
    return entry.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(entry);
}
inline int whole_number(const TableRow& row, const std::string& column) { return std::stoi(row.at(column)); }

inline std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> entries(1);
    for (const char c : line) {
        if (c == ',') {
            entries.emplace_back();
        } else {
            entries.back() += c;
        }
    }
    return entries;
}

/// Entries contain no quotes and no commas. @throws std::runtime_error for a row of the wrong length
inline std::vector<TableRow> reference_table(const std::string& name) {
    std::istringstream text(read_file(std::filesystem::path(MESHFOLIO_SOURCE_DIR) / "tests" / "reference" / (name + ".csv")));
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> columns = split(line);
    std::vector<TableRow> rows;
    while (std::getline(text, line)) {
        const std::vector<std::string> entries = split(line);
        if (entries.size() != columns.size()) throw std::runtime_error(name + ".csv: not a row: " + line);
        TableRow& row = rows.emplace_back();
        for (std::size_t i = 0; i < columns.size(); ++i) row[columns[i]] = entries[i];
    }
    return rows;
}

inline std::vector<TableRow> rows_of_mesh(const std::string& table, const std::string& mesh) {
    std::vector<TableRow> rows;
    for (TableRow& row : reference_table(table)) {
        if (row.at("mesh") == mesh) rows.push_back(std::move(row));
    }
    return rows;
}

inline std::vector<std::string> reference_meshes() {
    std::vector<std::string> names;
    for (const TableRow& row : reference_table("meshes")) names.push_back(row.at("mesh"));
    return names;
}

/// Bundled meshes are named data/…, the shared ones by their path below the folder of meshes.
inline bool is_bundled(const std::string& mesh) { return mesh.rfind("data/", 0) == 0; }
inline std::filesystem::path path_of_reference_mesh(const std::string& mesh) {
    return is_bundled(mesh) ? std::filesystem::path(MESHFOLIO_SOURCE_DIR) / mesh : testing_tools::shared_mesh_folder() / mesh;
}

}   // namespace meshfolio::testing
