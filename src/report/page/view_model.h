/// @file
/// The view model: all values that templates print, as JSON. Texts are safe but not escaped, numbers are formatted, and every condition is
/// a boolean, since the number 0 and the empty string are true to Mustache.
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
    std::string other_page = {};   // file of the other volume; empty: references to it are no links
    bool timings = true;
    bool pictures = true;              // pictures and plots inside the page
    bool page_numbers = false;         // the contents have marks for page numbers (print_pdf.h)
    bool plain_formulas = false;       // for readers without MathML
    bool paper = false;                // the page links to report.pdf
    bool plot_files = false;           // the page links to images/<plot>.svg
    bool columns = false;              // plots of one panel are drawn for a column of a paper
    bool single_views = true;          // the page links to the single pictures of a sheet
    bool models = false;               // models inside the page, which can turn them; false: only links
    std::string lab_questions = {};    // ids of questions with a laboratory in the page, each followed by a space
    bool passed_checks = true;         // false: lists of checks omit those that passed
    std::size_t most_checks = -1;      // listed in a section
    std::size_t table_rows = 200;      // longer tables show their first and last rows,
    std::size_t fewest_left_out = 1;   // unless fewer rows than this would be left out
};

/// Returns the view model of one volume of a document.
/// @throws std::logic_error with the id of a reference without target, or the name of an unknown formula
nlohmann::json view_model(const Document& document, const DrawnFigures& figures, const Templates& templates, const ViewOptions& options);

}   // namespace meshfolio::report
