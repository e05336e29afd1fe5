/// @file
/// The report as a page for A4 paper (templates/print.html), and that page as a PDF.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/drawn_figure.h"
#include "report/pdf/pdf_engine.h"
#include "report/writers.h"

namespace meshfolio::report {

struct PrintOptions {
    Volume volume = Volume::report;
    bool mathml = true;         // false: formulas as plain text, for engines that know no MathML
    bool page_numbers = true;   // in the contents; they may take a second pass of the engine
};

/// Returns one volume of a report as an HTML page for A4 paper, pictures inside. "@page:ID@" stands for the number of the page that the
/// heading ID is printed on.
std::string print_page(const Document& document, const DrawnFigures& figures, const Templates& templates, const PrintOptions& options);

struct PageHeading {
    std::string id;      // empty: none
    std::string title;   // without markup, words separated by one space
    int level = 1;       // of <h1> to <h6>
};

/// Returns the headings of an HTML page in their order.
std::vector<PageHeading> headings_of(const std::string& html);

struct PrintJob {
    std::string html;   // refers to no other file
    std::string title, author, creator;
    std::string date;                          // as pdf_date() writes it
    std::string attachment_name, attachment;   // empty name: none
};

/// Prints a page and returns the PDF, with the marks "@page:ID@" replaced by numbers. Equal jobs give equal bytes.
/// @param scratch  an empty folder for this call alone; its files are of no use afterwards
/// @throws EngineError if the page refers to other files, or the engine prints no usable PDF
std::string print_pdf(const PrintJob& job, const PdfEngine& engine, const std::filesystem::path& scratch);

}   // namespace meshfolio::report
