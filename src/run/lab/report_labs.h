/// @file
/// The live laboratories of a report's page.
#pragma once

#include <vector>

#include "output/cache/result_cache.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"
#include "run/stored_report.h"

namespace meshfolio::run {

/// Returns a laboratory for the mesh of each answered chapter that has a panel, decimated above 620 vertices; chapters share the laboratory
/// of a common mesh.
/// @param store  the cache, or null
std::vector<report::Lab> report_labs(const std::vector<ReportSection>& sections, const MeshLibrary& meshes, const ReportSettings& settings,
                                     output::ResultCache* store);

}   // namespace meshfolio::run
