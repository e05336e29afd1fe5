/// @file
/// results.json to the Document it was written from.
#pragma once

#include <string>
#include <string_view>

#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::report {

struct ReadReport {
    Document document;
    DrawnFigures figures;   // names of their files; pictures and models are read from those
    bool timings = true;    // it was written with them
};

/// The inverse of write_json(). It is strict: it refuses other versions, missing keys, wrong types, values
/// out of range, duplicate ids and dangling references. It ignores unknown keys.
/// @param file  what messages call it
/// @throws InputError naming the line and the place ("questions[0].tables[2].rows[1]")
ReadReport read_json(std::string_view text, const std::string& file);

}   // namespace meshfolio::report
