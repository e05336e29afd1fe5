/// @file
/// Reads results.json.
#pragma once

#include <string>
#include <string_view>

#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::report {

struct ReadReport {
    Document document;
    DrawnFigures figures;   // with the names of their files; pictures and models are not read
    bool timings = true;    // false: written without them
};

/// Returns the report that write_json() wrote as `text`, without the bytes of pictures and models. Ignores unknown keys.
/// @param file  its name in messages
/// @throws InputError with line and place ("questions[0].tables[2].rows[1]") for another version, missing keys, wrong types, values out of
///         range, duplicate ids and dangling references
ReadReport read_json(std::string_view text, const std::string& file);

}   // namespace meshfolio::report
