/// @file
/// A PDF as a browser leaves it, made fit to be handed in: nothing in it depends on the time or the place, it says what it is and
/// carries the results.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meshfolio::report {

struct OutlineEntry {
    std::string title;
    int level = 1;   // 1: at the top
    int page = 0;    // counted from 1; 0: none
};

struct PdfContents {
    std::string title;
    int pages = 0;
    std::vector<OutlineEntry> outline;   // in reading order
};

/// @throws EngineError if the bytes are no PDF that libqpdf can read
PdfContents contents_of_pdf(std::string_view pdf);

struct PdfDetails {
    std::string title, author, creator;
    std::string date = "D:19800101000000Z";    // of creation and change
    std::vector<std::string> outline;          // the titles in full, in reading order
    std::string attachment_name, attachment;   // empty name: none
    std::string attachment_description = {};
};

/// The date of SOURCE_DATE_EPOCH (seconds since 1970) as a PDF writes it; a fixed one for what is not such a number.
std::string pdf_date(const std::string& seconds);

/// Equal pages and details give equal bytes.
/// @throws EngineError if the PDF cannot be read, or its outline is not that of the details
std::string finish_pdf(std::string_view pdf, const PdfDetails& details);

}   // namespace meshfolio::report
