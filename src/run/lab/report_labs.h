/// @file
/// Which meshes of a report its page can experiment with.
#pragma once

#include <vector>

#include "output/cache/result_cache.h"
#include "report/writers.h"
#include "run/run_questions.h"

namespace meshfolio::run {

/// For each of the questions 4 to 7 that is answered the small one of its meshes, or one decimated; a mesh that several share once.
/// @param store  what earlier runs computed; may be null
std::vector<report::Lab> report_labs(const std::vector<QuestionResult>& results, const MeshLibrary& meshes, const ReportSettings& settings,
                                     output::ResultCache* store);

}   // namespace meshfolio::run
