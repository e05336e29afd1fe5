/// @file
/// What a batch takes from a report that is there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "report/batch/batch.h"
#include "run/batch/mesh_list.h"
#include "run/plan/plan.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// The settings of the report on one mesh of so many vertices (or half its triangles, where these are more).
ReportSettings settings_on(const BatchMesh& mesh, double vertices, ReportSettings settings);

/// Its row, with the picture of its first page.
/// @param out     the folder of the batch
/// @param folder  of the report, inside it
/// @throws InputError for a report that is not there, or not what it was
report::BatchRow row_of_report(const BatchMesh& mesh, const std::filesystem::path& out, const std::string& folder);

/// The same of a report that need not be made again: it is of the mesh with this content, these settings, this program, and none of its
/// sections failed. Nothing where there is none such.
/// @param settings  of the batch
std::optional<report::BatchRow> finished_row(const BatchMesh& mesh, const std::string& sha256, const ReportSettings& settings);

}   // namespace meshfolio::run
