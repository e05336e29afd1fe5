/// @file
/// The row of a batch, from a finished report.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "report/batch/batch.h"
#include "run/batch/mesh_list.h"
#include "run/plan/plan.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// Returns the settings of the report on one mesh: `settings` of the batch, with this mesh and the efforts planned for it.
/// @param vertices  of the mesh, or half the number of triangles if that is larger
ReportSettings settings_on(const BatchMesh& mesh, double vertices, ReportSettings settings);

/// Returns the row of a finished report, with the picture of its first page.
/// @param out     folder of the batch
/// @param folder  folder of the report, inside `out`
/// @throws InputError if the report is missing or damaged
report::BatchRow row_of_report(const BatchMesh& mesh, const std::filesystem::path& out, const std::string& folder);

/// Returns the row of a report that need not be made again; nothing if there is none. The report has this mesh, these settings and this
/// program, each section asked for without failure, and files that match its SHA256SUMS.
/// @param settings  of the batch
std::optional<report::BatchRow> finished_row(const BatchMesh& mesh, const std::string& sha256, const ReportSettings& settings);

}   // namespace meshfolio::run
