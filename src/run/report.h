/// @file
/// The road of every report: its sections are gathered, its figures drawn, its files written, printed and published.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"
#include "report/document.h"
#include "report/writers.h"
#include "run/progress.h"
#include "run/report_files.h"
#include "run/section_cache.h"
#include "run/settings/report_settings.h"
#include "run/stored_report.h"

namespace meshfolio::run {

/// Returns a section and puts its stored files into the folder of the report; returns nothing if it does not have the section. Thread-safe.
using Source =
    std::function<std::optional<ReportSection>(std::string_view id, const std::filesystem::path& folder, ProgressDisplay& display)>;

/// A report that is to be made. `report`, `--only`, `--from`, `merge` and `verify` differ in the sources of their sections.
struct ReportRequest {
    std::shared_ptr<const ReportSettings> settings;
    report::Templates templates{};
    std::string junit = {};                // file for the checks; empty: none
    report::Document head = {};            // title, author, course and provenance; no sections
    std::vector<std::string> ids = {};     // of the sections, in their order
    std::vector<Source> sources = {};      // the first that has a section gives it
    std::vector<std::string> notes = {};   // warnings to be shown at the end

    bool renders_again = false;                      // nothing is computed: the timings are those of the stored report
    bool cites_source = false;                       // citations get the lines of this program's source, else they keep theirs
    double expected_seconds = 0;                     // of the computation; 0: not known
    std::function<std::string()> source_text = {};   // of src.txt; empty: none
    std::function<std::vector<report::Lab>(const std::vector<ReportSection>&)> labs = {};   // of the page; empty: none
    std::shared_ptr<output::ResultCache> store = nullptr;                                   // null: no cache
    std::shared_ptr<const SectionCache> cache = nullptr;                                    // of sections answered now; null: none is kept
};

/// A report that was made: its document, and where it lies.
struct MadeReport {
    report::Document document;
    Published published = {};
    std::vector<std::string> notes = {};
    double seconds = 0;   // 0: nothing was computed
};

/// Makes and publishes a report. A failed section or check is no error here.
/// @throws OutputError, EngineError; InputError for stored files that have changed
MadeReport make_report(const ReportRequest& request);

/// Returns the document of a report with all its sections; draws and writes nothing. @throws InputError
report::Document gathered_document(const ReportRequest& request);

/// Prints warnings, failures, "7 of 7 questions answered, 457 checks passed, 9.8 s", and the path of the page.
/// @return failed if a section or a check has failed
ExitCode print_outcome(const MadeReport& made);

/// Returns the request of `meshfolio report`: sections are computed, except for those in the cache and, with --only, sections kept from the
/// report that it renews. Prints the plan if --time is given, and warns if the time cannot be kept.
/// @throws UsageError, InputError, also for work that needs more memory than there is
ReportRequest report_request(const ReportFlags& flags);

/// Returns the plan of `meshfolio report` with these flags, as a table for people or, with --json, as JSON.
std::string plan_text(const ReportFlags& flags);

/// Returns the request of `meshfolio report --from results.json` and `meshfolio merge DIR…`: a finished report, or the parts of one,
/// rendered again without computing anything. Title, author, course and templates may be others.
/// @throws InputError for parts that do not fit together; UsageError for options that would need computing
ReportRequest rendering_request(const ReportFlags& flags);

}   // namespace meshfolio::run
