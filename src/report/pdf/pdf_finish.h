/// @file
/// Finishes the PDF of a browser: removes all that depends on time and place, and adds title, outline and the results as attachment.
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

/// Returns title, number of pages and outline of a PDF.
/// @throws EngineError if libqpdf cannot read it
PdfContents contents_of_pdf(std::string_view pdf);

struct PdfDetails {
    std::string title, author, creator;
    std::string date = "D:19800101000000Z";    // of creation and change
    std::vector<std::string> outline;          // full titles in reading order
    std::string attachment_name, attachment;   // empty name: none
};

/// Returns a number of seconds since 1970, such as SOURCE_DATE_EPOCH, as a date of PDF; 1 January 1980 for other texts.
std::string pdf_date(const std::string& seconds);

/// Returns the PDF with the details and its full outline. Equal pages and details give equal bytes.
/// @throws EngineError if the PDF cannot be read, or its outline differs from that of the details
std::string finish_pdf(std::string_view pdf, const PdfDetails& details);

}   // namespace meshfolio::report
