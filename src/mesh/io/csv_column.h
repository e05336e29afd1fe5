/// @file
/// One column of a table of numbers, as written by `curvature --csv`, `spectrum --csv`, spreadsheets and other programs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

inline constexpr std::uintmax_t largest_csv = std::uintmax_t{1} << 30;   // bytes

struct NumberColumn {
    Vector values;             // NaN for an empty cell, nan, or inf
    Vector rounding;           // half a unit of the last digit of each value: it may be rounded by so much
    long first_infinite = 0;   // line of the first inf; 0: none
};

enum class MoreRows { refused, left_out };

/// Reads a column of numbers. Cells are separated by ';', a tab, ',' or blanks: the first of these that the header contains. Blanks and
/// quotes around cells are removed; a decimal comma is read unless ',' separates cells. Blank lines and lines that begin with '#' or '%'
/// are left out, but the header may begin so. In a table of one column, which needs no header, blank lines are empty cells if rows would be
/// missing. The time is linear in the bytes.
/// @param file   its name in messages
/// @param names  of the column; the first that is in the header is taken, in its own case before another case
/// @param rows   how many must follow; `more` says whether further ones are an error
/// @throws InputError with the line: no finite number up to 1e100, more or fewer cells than the header, rows missing or left over
NumberColumn csv_column(std::string_view bytes, const std::string& file, const std::vector<std::string>& names, Eigen::Index rows,
                        MoreRows more = MoreRows::refused);

}   // namespace meshfolio
