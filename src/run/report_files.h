/// @file
/// A report as files: written, published, and summarised in a few lines for the terminal.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/errors.h"
#include "output/publish/publish.h"
#include "questions/core/chapter.h"
#include "report/document.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// Writes everything of the report but the pictures of meshes into `folder`: the pages
/// and the Markdown of both volumes, summary.md, results.json, tables, plots, meshes.
/// @param stored  ids of sections whose tables, plots and meshes are there already
/// @throws OutputError
void write_report_files(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                        const report::WriteOptions& options, const std::vector<const Answer*>& answers, const std::set<std::string>& stored,
                        const std::filesystem::path& folder);

/// Has a section or a check failed? What is undecided is no failure.
bool has_failed(const report::Document& document);

/// Warnings, failures, failed checks and the number of undecided ones, on stderr.
void summarise(const report::Document& document);

struct Published {
    std::filesystem::path folder, wanted;   // where it is, and where it was to be
    output::Notes notes;
};

/// Publishes what has been written. A report with a failure does not take the place of one without: it goes to `<out>.failed`, which the
/// next good one removes.
/// @param junit  file for the checks; empty: none is wanted
/// @throws OutputError
Published publish_report(output::Publication& publication, const report::Document& document, const output::Publication::Digests& digests,
                         const ReportSettings& settings, const std::string& junit);

/// Prints warnings, a summary of failures, "7 of 7 questions answered, 457 checks passed, 9.8 s", and the path of the page.
/// @param seconds  that it took; 0: nothing was computed
ExitCode tell(const Published& published, const std::vector<std::string>& notes, const report::Document& document, double seconds);

}   // namespace meshfolio::run
