/// @file
/// `meshfolio batch`: one report for each mesh. Each report is a process of its own, so that a crash costs only one row.
#pragma once

#include <string>
#include <vector>

#include "base/errors.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

struct BatchFlags {
    ReportFlags report;   // of every report; `out` is the folder of the batch
    std::vector<std::string> meshes, lists;
    std::string jobs;
    bool plan = false;   // only print the folder of each mesh
};

/// Makes a report for each mesh and keeps the index up to date. A mesh with a finished_row() gets no new report. With `plan`, only prints
/// folder and file of each mesh.
/// @return failed if a mesh has no report or one with a failure; output if a report could not be written
/// @throws UsageError, InputError, OutputError, EngineError before any work; OutputError if the index cannot be written
ExitCode run_batch(const BatchFlags& flags);

}   // namespace meshfolio::run
