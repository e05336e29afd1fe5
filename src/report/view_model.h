/// @file
/// Everything the templates print, as JSON: texts are safe but not escaped, numbers are words already, and every condition is
/// an explicit boolean (to Mustache the number 0 and the empty string are true).
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "report/document.h"
#include "report/writers.h"

namespace meshfolio::report {

struct ViewOptions {
    bool timings = true;
    bool pictures = true;           // previews and plots inside, for a page of one file
    bool plot_files = false;        // images/<plot>.svg are there to link to
    bool single_views = true;       // links to the pictures a sheet is made of
    bool passed_checks = true;      // in the lists of checks
    std::size_t table_rows = 200;   // longer tables show their first and last rows
};

/// @throws std::logic_error naming an id that a text refers to and nothing has, or the name of an unknown formula
nlohmann::json view_model(const Document& document, const DrawnFigures& figures, const Templates& templates, const ViewOptions& options);

}   // namespace meshfolio::report
