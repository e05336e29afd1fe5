/// @file
/// Which meshes of a report its page can experiment with.
#pragma once

#include <vector>

#include "output/cache/result_cache.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"
#include "run/stored_report.h"

namespace meshfolio::run {

/// For each of the questions 4 to 7 that is answered the small one of its meshes, or one decimated; a mesh that several share once.
/// @param store  the cache, or null
std::vector<report::Lab> report_labs(const std::vector<ReportSection>& sections, const MeshLibrary& meshes, const ReportSettings& settings,
                                     output::ResultCache* store);

}   // namespace meshfolio::run
