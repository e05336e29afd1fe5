/// @file
/// The gate in front of tinyobjloader, which takes many bad files without a word, and crashes on some. Every statement of the
/// file is checked here first; what comes out is a text that cannot be misread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/io/warning_tally.h"

namespace meshfolio {

struct CheckedObj {
    std::vector<double> coordinates;   // x y z of each vertex, correctly rounded
    std::vector<double> colors;        // r g b, from 0 to 1, of those that have one
    std::string text;                  // "f a b c …" only, one face a line, indices counted from 1
    std::vector<long> face_lines;      // in the file, of each "f" of the text
    WarningTally warnings;
    bool free_form = false;   // there were free-form surfaces
    std::string unknown;      // the first unknown statement and its line, for messages; empty: none
};

/// Checks every number, index and keyword. Faces may name vertices that come later: whether an index is too large only the whole
/// file tells, and is left to the caller.
/// @throws InputError with the physical line
CheckedObj check_obj(std::string_view text, const std::string& file);

}   // namespace meshfolio
