/// @file
/// submission.zip: what the assignment asks for, in one archive that says what it is and can be checked.
#pragma once

#include <string>
#include <vector>

#include "output/publish/publish.h"
#include "submission/readiness.h"

namespace meshfolio::submission {

struct Submission {
    std::string zip;
    std::size_t files = 0;
    std::vector<std::string> warnings;
};

/// The report's files, the source tree below source/, INSTRUCTIONS.md, NOTICES.md and MANIFEST.sha256 of all others. The same report and
/// author give the same bytes.
/// @throws what require_ready() throws
Submission pack(const ReportFolder& report, const SourceListing& listing, const SubmissionOptions& options);

/// The report's folder again, with the archive in it and its sums renewed, all at once.
/// @throws OutputError
output::Notes publish(const ReportFolder& report, const Submission& submission);

}   // namespace meshfolio::submission
