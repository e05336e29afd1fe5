/// @file
/// What `meshfolio batch` does: a report a mesh, each by a run of this program of its own, so that what ends one costs only its row.
#pragma once

#include <string>
#include <vector>

#include "base/errors.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

struct BatchFlags {
    ReportFlags report;   // of every report; its `out` is the folder of them all
    std::vector<std::string> meshes, lists;
    std::string jobs;
    bool plan = false;   // only say which folder each mesh gets
};

/// Finished reports of the same meshes, settings and program are kept, the others made; the index is renewed after each.
/// @return failed where a mesh has no report or one with a failure; output where one could not be written
/// @throws UsageError, InputError, OutputError, EngineError before any work; OutputError when the index cannot be written
ExitCode run_batch(const BatchFlags& flags);

}   // namespace meshfolio::run
