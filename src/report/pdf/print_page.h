/// @file
/// The report as a page to be printed: set by templates/print.html for A4, its pictures inside.
#pragma once

#include <string>
#include <vector>

#include "report/drawn_figure.h"
#include "report/page/view_model.h"
#include "report/writers.h"

namespace meshfolio::report {

struct PrintOptions {
    Volume volume = Volume::report;
    bool mathml = true;         // the engine sets it; else formulas are plain text
    bool page_numbers = true;   // in the contents, which takes a second pass of the engine
};

/// The page; nothing in it depends on the time. "@page:ID@" stands for the number of the page that the heading ID is on.
std::string print_page(const Document& document, const DrawnFigures& figures, const Templates& templates, const PrintOptions& options);

struct PageHeading {
    std::string id, title;
    int level = 1;
};

/// The headings of a page in order, their titles without markup and with single spaces.
std::vector<PageHeading> headings_of(const std::string& html);

}   // namespace meshfolio::report
