/// @file
/// Checks whether a report can be submitted, and collects facts of results.json for the submission.
#pragma once

#include <string>
#include <vector>

#include "submission/report_folder.h"
#include "submission/source_listing.h"

namespace meshfolio::submission {

struct SubmissionOptions {
    std::string author;                   // empty: the one the report names
    bool pdf = true;                      // report.pdf and appendix.pdf are required and packed
    bool images = false;                  // images/ is packed, and the Markdown, which shows them
    std::vector<std::string> questions;   // ids that must be answered
};

struct ReportFacts {
    std::string title, author, course;
    std::string version, commit;
    bool own_meshes = false;             // some input is none of the bundled meshes
    std::vector<std::string> warnings;   // problems that do not prevent a submission
};

/// @throws SubmissionError if a question is missing, skipped or failed, or a citation does not resolve; InputError if a file is missing
/// or was written by another version; UsageError if no author is known or another than the report names
ReportFacts require_ready(const ReportFolder& report, const SourceListing& listing, const SubmissionOptions& options);

}   // namespace meshfolio::submission
