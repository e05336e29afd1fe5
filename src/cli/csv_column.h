/// @file
/// One column of a CSV file, for `render --values`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace meshfolio::cli {

inline constexpr std::uintmax_t largest_csv = std::uintmax_t{1} << 30;   // bytes

/// The column called `column`, one row a vertex; empty cells are NaN. Cells are not quoted: `curvature --csv` writes none that would be.
/// @param file  what messages call it
/// @throws InputError with the line of what is no finite number up to 1e100, of a row with more or fewer cells than the header, or where
///         rows are missing or left over
Vector csv_column(std::string_view bytes, const std::string& file, const std::string& column, Eigen::Index rows);

}   // namespace meshfolio::cli
