/// @file
/// A report as files: written, published, and summarised in a few lines for the terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/errors.h"
#include "output/publish/publish.h"
#include "questions/core/chapter.h"
#include "report/document.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// Writes the pages and the Markdown of both volumes, summary.md, results.json, tables and plots into `folder`. @throws OutputError
void write_report_files(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                        const report::WriteOptions& options, const std::filesystem::path& folder);

/// Writes the output meshes of a chapter, each where its section says. @throws OutputError
void write_meshes(const Answer& answer, const std::filesystem::path& folder);

/// Returns true if a section or a check has failed. An undecided check is no failure.
bool has_failed(const report::Document& document);

/// Prints warnings, failures and failed checks, at most four of each, and the number of undecided checks on stderr.
void summarise(const report::Document& document);

struct Published {
    std::filesystem::path folder, wanted;   // of the report, and the one that was asked for
    output::Notes notes;
};

/// Writes SHA256SUMS and the JUnit file, and publishes a report that has been written. A report with a failure does not replace one
/// without: it goes to `<out>.failed`, which the next good report removes.
/// @param junit  file for the checks; empty: none
/// @throws OutputError
Published publish_report(output::Publication& publication, const report::Document& document, const output::Publication::Digests& digests,
                         const ReportSettings& settings, const std::string& junit);

/// Prints the notes of a publication and, if a report with a failure did not replace one without, where it is.
void print_place(const Published& published);

/// Returns "7 of 7 questions answered, 457 checks passed, 9.8 s", with failed and undecided checks if there are any, without questions if
/// none was asked. @param seconds  0: left out of the text
std::string verdict_on(const report::Document& document, double seconds);

}   // namespace meshfolio::run
