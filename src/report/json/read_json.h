/// @file
/// results.json to the Document it was written from.
#pragma once

#include <string>
#include <string_view>

#include "report/document.h"

namespace meshfolio::report {

struct ReadReport {
    Document document;
    DrawnFigures figures;   // names of their files; pictures and models are read from those
    bool timings = true;    // it was written with them
};

/// The inverse of write_json(), also of earlier versions (upgrade_json.h), strict: a key that is missing, a value of another type or out of
/// its limits, an id used twice or referred to in vain is refused. Keys that are not known are passed over.
/// @param file  what messages call it
/// @throws InputError naming the line and the place ("questions[0].tables[2].rows[1]")
ReadReport read_json(std::string_view text, const std::string& file);

}   // namespace meshfolio::report
