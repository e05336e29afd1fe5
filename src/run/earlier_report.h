/// @file
/// A finished report read back from its folder: to be rendered again (`report --from`), joined with others (`merge`), or renewed in part
/// (`report --only`).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "output/publish/publish.h"
#include "report/writers.h"
#include "run/settings/report_settings.h"

namespace meshfolio::run {

class EarlierReport {
public:
    /// @param results  its results.json; what it names lies beside it, each file checked against SHA256SUMS when it is read
    /// @throws InputError
    explicit EarlierReport(const std::filesystem::path& results);

    std::string file;   // results.json as it was named
    report::Document document;
    report::DrawnFigures figures;   // pictures and models are empty until they are restored
    bool timings = true;            // it was written with them

    /// Reads the pictures and models of every figure. One without its sheet is left out: the page shows a box in its place.
    void restore_figures();
    /// Those of one figure. @return false where its sheet is missing
    bool restore(report::DrawnFigure& figure) const;

    /// Nothing where the file is missing. @throws InputError for one that is not what it was
    std::optional<std::string> bytes_of(const std::string& path) const;

    /// Every file that a report rendered again takes over as it is. @return the names of those that are missing
    std::vector<std::string> copy_to(const std::filesystem::path& target, output::Publication::Digests& digests) const;

    /// Of the live laboratory: results.json does not hold it, the page does; one that has been changed since is not asked.
    std::vector<report::Lab> labs() const;

private:
    std::filesystem::path folder_;
    std::map<std::string, output::FileSum> sums_;
};

/// Does the folder hold a report without failures, of any version?
bool ended_well(const std::filesystem::path& folder);

struct JoinedReport {
    report::Document document;
    report::DrawnFigures figures;
    std::vector<report::Lab> labs;
};

/// Each section from the first part that has it.
/// @param parts  at least one; their figures are moved from
/// @throws InputError naming two parts, and what they do not have in common: inputs, settings, program, or what both say of one section
JoinedReport joined(std::vector<EarlierReport>& parts);

/// `meshfolio report --from results.json` and `meshfolio merge DIR…`: one earlier report, or the parts of one, rendered again from their
/// own files and without computing anything.
/// Title, author, course and template may be others (--config, --templates); pictures, models and meshes are those beside results.json,
/// each checked against SHA256SUMS.
/// @return failed when a section or a check of the earlier report has failed
/// @throws InputError for a file that is not what it was, or parts that do not fit together; UsageError for options that would need
/// computing, OutputError
ExitCode report_from_results(const ReportFlags& flags);

}   // namespace meshfolio::run
