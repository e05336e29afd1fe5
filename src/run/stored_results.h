/// @file
/// Combines answers of this run and stored answers of earlier runs in one report.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "output/publish/publish.h"
#include "run/run_questions.h"

namespace meshfolio::run {

/// The cache; null if MESHFOLIO_FAIL is set, as such a run neither stores nor takes answers.
std::unique_ptr<output::ResultCache> cache_for_report();

/// The answers whose output meshes are still to be written.
std::vector<const Answer*> answers_of(const std::vector<QuestionResult>& results);

std::set<std::string> stored_sections(const std::vector<QuestionResult>& results);

void add_stored_figures(const std::vector<QuestionResult>& results, report::DrawnFigures& figures);

/// Keeps the answers of this run, whose files have all been written, and trims the cache; one that cannot be written to is warned of.
/// @return what is known of the digests of files in the report's folder
output::Publication::Digests stored_and_kept(const std::vector<QuestionResult>& results, const report::DrawnFigures& figures,
                                             output::ResultCache* store, const QuestionCache* cache);

}   // namespace meshfolio::run
