/// @file
/// A finished report read back, whole or section by section: from its folder, or from the cache, whose entries are reports of one section.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/cache/result_cache.h"
#include "output/publish/file_sums.h"
#include "questions/core/chapter.h"
#include "report/json/read_json.h"
#include "report/writers.h"

namespace meshfolio::run {

inline constexpr const char* results_file = "results.json";
inline constexpr std::uintmax_t largest_results = std::uintmax_t{256} << 20;   // bytes

/// A section of the report that is being made.
struct ReportSection {
    enum class Origin { skipped, answered, cache, report };

    Answer answer = {};                      // of a stored section the section alone
    Origin origin = Origin::skipped;         // in this run; stored in the cache or in a finished report; or none
    report::DrawnFigures figures = {};       // of a stored section
    output::Digests files = {};              // of a stored section, by path: they lie in the folder of the report that is being made
    std::vector<std::string> missing = {};   // paths of a stored section's files that are gone
};

/// Returns the paths of a section's files that are not written from the document: pictures, models and meshes.
std::vector<std::string> files_of(const report::Section& section, const report::DrawnFigures& figures);

/// Returns the path "jpeg/q1_h_3.jpg" under which the cache keeps the JPEG of a picture; a report has it only in its pages.
std::string jpeg_file(const std::string& figure, std::size_t picture);

class StoredReport {
public:
    /// Reads a report. @param results  its results.json; the files it names lie beside it, each checked against SHA256SUMS when it is read
    /// @throws InputError
    explicit StoredReport(const std::filesystem::path& results);
    /// Reads an entry of the cache, a report of one section. @param sums  its SHA256SUMS
    /// @throws InputError where the entry is damaged
    StoredReport(const std::string& sums, output::ResultCache& store);

    std::string file;   // results.json as it was named
    report::Document document;
    report::DrawnFigures figures;   // without the bytes of pictures and models
    bool timings = true;            // the report was written with them

    /// Copies the files of a section into `folder` and reads its pictures and models. A figure whose sheet is gone is left out.
    /// @throws InputError for a file that SHA256SUMS does not match
    ReportSection section(const report::Section& section, const std::filesystem::path& folder) const;

    /// Returns the bytes of a file of the report; nothing if it is gone. @throws InputError if SHA256SUMS does not match
    std::optional<std::string> bytes_of(const std::string& path) const;

    /// Returns the live laboratories of the page index.html; none, with a warning, if SHA256SUMS does not match the page.
    std::vector<report::Lab> labs() const;

private:
    std::function<std::optional<std::string>(const std::string& path, const std::string& digest)> read_;
    std::map<std::string, output::FileSum> sums_;

    void read(const std::string& results);
    bool restore(const std::string& id, report::DrawnFigure& figure) const;
};

/// Reads results.json of a folder, or a file. @throws InputError
report::ReadReport read_report(const std::filesystem::path& path);

/// Returns true if the folder holds a report without failures, or one of another version.
bool ended_well(const std::filesystem::path& folder);

}   // namespace meshfolio::run
