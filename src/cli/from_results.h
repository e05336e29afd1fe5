/// @file
/// `meshfolio report --from results.json`: an earlier report rendered again, from its own files and without computing anything.
#pragma once

#include "cli/report_settings.h"
#include "errors.h"

namespace meshfolio::cli {

/// Title, author, course and template may be others (--config, --templates); pictures, models and meshes are those beside results.json,
/// each checked against SHA256SUMS.
/// @return failed when a section or a check of the earlier report has failed
/// @throws InputError for a file that is not what it was, UsageError for options that would need computing, OutputError
ExitCode report_from_results(const ReportFlags& flags);

}   // namespace meshfolio::cli
