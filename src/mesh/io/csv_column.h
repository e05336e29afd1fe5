/// @file
/// One column of a CSV file of numbers, such as `curvature --csv` and `spectrum --csv` write.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

inline constexpr std::uintmax_t largest_csv = std::uintmax_t{1} << 30;   // bytes

struct CsvRules {
    std::optional<Eigen::Index> rows = {};   // so many there must be, one a vertex; none: as many as there are
    bool lenient = false;                    // blanks around cells, and "nan" for an empty one, are taken too: other programs write them
};

/// The column called `column`; empty cells are NaN. Cells are not quoted: no number needs it.
/// @param file  what messages call it
/// @throws InputError with the line of what is no finite number up to 1e100, of a row with more or fewer cells than the header, or where
///         rows are missing or left over
Vector csv_column(std::string_view bytes, const std::string& file, const std::string& column, const CsvRules& rules = {});

/// The names of the columns, blanks around them taken off. @throws InputError for an empty file
std::vector<std::string> csv_header(std::string_view bytes, const std::string& file);

}   // namespace meshfolio
