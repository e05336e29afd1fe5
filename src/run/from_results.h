/// @file
/// `meshfolio report --from results.json` and `meshfolio merge DIR…`: one earlier report, or the parts of one, rendered again from their
/// own files and without computing anything.
#pragma once

#include "base/errors.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// Title, author, course and template may be others (--config, --templates); pictures, models and meshes are those beside results.json,
/// each checked against SHA256SUMS.
/// @return failed when a section or a check of the earlier report has failed
/// @throws InputError for a file that is not what it was, or parts that do not fit together; UsageError for options that would need
/// computing, OutputError
ExitCode report_from_results(const ReportFlags& flags);

}   // namespace meshfolio::run
