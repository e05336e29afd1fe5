/// @file
/// Runs the questions, several at a time; one that fails does not take the others with it.
#pragma once

#include <vector>

#include "cli/progress.h"
#include "cli/report_settings.h"
#include "questions/question.h"

namespace meshfolio::cli {

/// One answer a question, then one a supporting section, in their order. A question that throws has a failed section with its message, one
/// that was not asked for (or stopped by --fail-fast) a skipped one. Output meshes are placed where the settings say. MESHFOLIO_FAIL=q4,q6
/// in the environment makes these questions fail.
std::vector<Answer> run_questions(const MeshLibrary& meshes, const ReportSettings& settings, ProgressDisplay& display);

}   // namespace meshfolio::cli
