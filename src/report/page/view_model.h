/// @file
/// Everything the templates print, as JSON: texts are safe but not escaped, numbers are words already, and every condition is
/// an explicit boolean (to Mustache the number 0 and the empty string are true).
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "report/document.h"
#include "report/drawn_figure.h"
#include "report/writers.h"

namespace meshfolio::report {

struct ViewOptions {
    Volume volume = Volume::report;
    std::string other_page = {};   // of the other volume, for links; empty: what is there is called by its number alone
    bool timings = true;
    bool pictures = true;              // pictures and plots inside, for a page of one file
    bool page_numbers = false;         // "@page:ID@" in the page becomes the number of the printed page that ID is on (print_pdf.h)
    bool plain_formulas = false;       // for readers without MathML
    bool paper = false;                // there is a report.pdf to link to
    bool plot_files = false;           // images/<plot>.svg are there to link to
    bool columns = false;              // plots of one panel for a column of a paper
    bool single_views = true;          // links to the pictures a sheet is made of
    bool models = false;               // inside, for a page that can turn them; false: only linked to
    std::string lab_questions = {};    // ids, a space behind each: those with a laboratory in the page
    bool passed_checks = true;         // in the lists of checks; false: only the others
    std::size_t most_checks = -1;      // at most that many a section
    std::size_t table_rows = 200;      // longer tables show their first and last rows,
    std::size_t fewest_left_out = 1;   // unless fewer than these would be left out
};

/// @throws std::logic_error naming an id that a text refers to and nothing has, or the name of an unknown formula
nlohmann::json view_model(const Document& document, const DrawnFigures& figures, const Templates& templates, const ViewOptions& options);

}   // namespace meshfolio::report
