/// @file
/// One column of a table of numbers, such as `curvature --csv` and `spectrum --csv`, spreadsheets and other programs write.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

inline constexpr std::uintmax_t largest_csv = std::uintmax_t{1} << 30;   // bytes

struct NumberColumn {
    Vector values;             // NaN where there is none: an empty cell, nan, inf
    Vector rounding;           // as many: half a unit of the last digit written, by which the number that was meant may be another
    long first_infinite = 0;   // line of the first inf; 0: there is none
};

enum class MoreRows { refused, left_out };

/// So many rows of a column. Cells are parted by ';', a tab, ',' or blanks, whichever of these comes first and is in the header; blanks and
/// quotes around them are taken off, and a decimal comma is read where ',' parts nothing. Lines that are blank or begin with '#' or '%'
/// are left out, but the header may begin so, and in a table of one column blank lines are empty cells where rows would be missing.
/// A table of one column needs no header. The time taken is linear in the bytes.
/// @param file   what messages call it
/// @param names  the column is the first of these that the header has as it is written here, or else in another case
/// @throws InputError with the line: no finite number up to 1e100, more or fewer cells than the header, rows missing or left over
NumberColumn csv_column(std::string_view bytes, const std::string& file, const std::vector<std::string>& names, Eigen::Index rows,
                        MoreRows more = MoreRows::refused);

}   // namespace meshfolio
