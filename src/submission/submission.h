/// @file
/// submission.zip: everything that the assignment asks for, in an archive that describes itself and can be checked.
#pragma once

#include <string>
#include <vector>

#include "output/publish/publish.h"
#include "report/document.h"
#include "submission/report_folder.h"
#include "submission/source_listing.h"

namespace meshfolio::submission {

struct SubmissionOptions {
    std::string author;                   // of the submission; empty: the author that the report names
    bool pdf = true;                      // report.pdf and appendix.pdf are required and packed
    bool images = false;                  // images/ is packed, and the Markdown, which shows them
    bool tests = true;                    // the tests are packed with the source
    std::vector<std::string> questions;   // ids that must be answered
};

/// A report that may be submitted.
struct ReadyReport {
    report::Document document;
    std::string author;
    std::vector<std::string> warnings;   // problems that do not prevent a submission
    bool is_complete = true;             // false: it lacks the author's name or src.txt, and is to be rendered again
};

/// Checks a report and reads its results.json.
/// @throws SubmissionError if a question is missing, skipped or failed, or a citation does not resolve; InputError if a file is missing
/// or was written by another version; UsageError if no author is known
ReadyReport require_ready(const ReportFolder& report, const SourceListing& listing, const SubmissionOptions& options);

struct Submission {
    std::string zip;   // bytes of the archive
    std::size_t files = 0;
    std::vector<std::string> warnings;
};

/// Packs the report's files, the source tree below source/, INSTRUCTIONS.md, NOTICES.md and a MANIFEST.sha256 of all of them. Equal reports
/// and authors give equal bytes.
/// @throws like require_ready()
Submission pack(const ReportFolder& report, const SourceListing& listing, const SubmissionOptions& options);

/// Publishes the report's folder again in one step: its files as they were read, submission.zip and new sums. Returns messages for the
/// user.
/// @throws OutputError
output::Notes publish(const ReportFolder& report, const Submission& submission);

}   // namespace meshfolio::submission
