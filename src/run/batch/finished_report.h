/// @file
/// What a batch takes from an existing report.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "report/batch/batch.h"
#include "run/batch/mesh_list.h"
#include "run/plan/plan.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// The settings of the report on one mesh. @param vertices  of the mesh, or half its triangles if that is more
ReportSettings settings_on(const BatchMesh& mesh, double vertices, ReportSettings settings);

/// Its row, with the picture of its first page.
/// @param out     the folder of the batch
/// @param folder  of the report, inside it
/// @throws InputError for a report that is not there, or not what it was
report::BatchRow row_of_report(const BatchMesh& mesh, const std::filesystem::path& out, const std::string& folder);

/// The same of a report that need not be made again: it is of the mesh with this content, these settings, this program, none of its
/// sections failed, and each of its files is as SHA256SUMS says. Nothing if there is no such report.
/// @param settings  of the batch
std::optional<report::BatchRow> finished_row(const BatchMesh& mesh, const std::string& sha256, const ReportSettings& settings);

}   // namespace meshfolio::run
