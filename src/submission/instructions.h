#pragma once

#include <string>
#include <vector>

#include "submission/readiness.h"
#include "submission/source_tree.h"

namespace meshfolio::submission {

/// INSTRUCTIONS.md from templates/instructions.md: what the archive holds, how to build and run it, where each question is.
std::string instructions(const ReportFacts& facts, const SourceListing& listing, const std::vector<SourceFile>& tree,
                         const SubmissionOptions& options);

}   // namespace meshfolio::submission
