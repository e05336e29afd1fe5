/// @file
/// A page to a PDF. One function of its input, which holds no path and no time: equal input gives equal bytes.
#pragma once

#include <filesystem>
#include <string>

#include "report/pdf/pdf_engine.h"

namespace meshfolio::report {

struct PrintJob {
    std::string html;   // refers to nothing but itself
    std::string title, author, creator;
    std::string date;                          // as pdf_date() writes it
    std::string attachment_name, attachment;   // empty name: none
};

/// Each "@page:ID@" of the page becomes the number of the page that the heading ID is printed on.
/// @param scratch  an empty folder for this alone; what lies in it afterwards is of no use
/// @throws EngineError saying what the engine did instead
std::string print_pdf(const PrintJob& job, const PdfEngine& engine, const std::filesystem::path& scratch);

}   // namespace meshfolio::report
