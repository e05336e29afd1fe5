/// @file
/// The end of every run that makes a report: publishes it and prints a summary.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/errors.h"
#include "output/publish/publish.h"
#include "report/document.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

struct Published {
    std::filesystem::path folder, wanted;   // where it is, and where it was to be
    std::string note;                       // what to warn of; else empty
};

/// Publishes what has been written. A report with a failure does not take the place of one without: it goes to `<out>.failed`, which the
/// next good one removes.
/// @param junit  file for the checks; empty: none is wanted
/// @throws OutputError
Published publish_report(output::Publication& publication, const report::Document& document, const output::Publication::Digests& digests,
                         const ReportSettings& settings, const std::string& junit);

/// Prints warnings, a summary of failures, and the path of the page.
ExitCode tell(const Published& published, std::vector<std::string> notes, const report::Document& document);

}   // namespace meshfolio::run
