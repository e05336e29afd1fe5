/// @file
/// Runs the questions in parallel; a failure of one does not affect the others.
#pragma once

#include <optional>
#include <vector>

#include "questions/core/chapter.h"
#include "run/progress.h"
#include "run/question_cache.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

/// A question answered in this run, or an answer of an earlier one.
struct QuestionResult {
    Answer answer;                        // of a stored one only the section
    std::optional<StoredAnswer> stored;   // by an earlier run
    std::vector<MeshLookup> lookups;      // of a question that has been answered now

    const report::Section& section() const { return answer.section; }
};

/// One result for each chapter of the report and for each that is kept, in their order. A question that throws has a failed section with
/// its message, one that was not asked for (or stopped by --fail-fast) a skipped one. Output meshes are placed where the settings say.
/// MESHFOLIO_FAIL=q4,q6 in the environment makes these questions fail.
/// @param cache  where answers of earlier runs are looked for; null: nowhere
/// @param kept  in place of sections that are not asked for
std::vector<QuestionResult> run_questions(const MeshLibrary& meshes, const ReportSettings& settings, const QuestionCache* cache,
                                          const std::map<std::string, StoredAnswer>& kept, ProgressDisplay& display);

}   // namespace meshfolio::run
