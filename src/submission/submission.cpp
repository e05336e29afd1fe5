#include "submission/submission.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/sha256.h"
#include "output/publish/folder_system.h"
#include "output/publish/publish.h"
#include "submission/instructions.h"
#include "submission/source_tree.h"
#include "submission/suspicious_file.h"
#include "submission/zip_archive.h"

namespace meshfolio::submission {

namespace {

constexpr const char* archive_file = "submission.zip";
constexpr const char* manifest_file = "MANIFEST.sha256";
constexpr const char* notices_source = "src/submission/NOTICES.md";

/// Path in the archive → bytes.
using Contents = std::map<std::string, std::string_view>;

bool is_packed(const std::string& path, const SubmissionOptions& options) {
    if (path == archive_file) return false;   // of an earlier submission
    if (path == "report.pdf") return options.pdf;
    if (path == "report.md" || path.starts_with("images/")) return options.images;
    return true;
}

/// The scripts of our own are the only programs; whatever else was in the source folder when this program was built, is refused.
void enter_source(const std::vector<SourceFile>& tree, Contents& contents) {
    for (const SourceFile& file : tree) {
        const std::string kind = is_script(file.bytes) ? "" : program_kind(file.bytes), problem = path_problem(file.path);
        if (!kind.empty() || !problem.empty()) {
            throw InputError({"source/" + file.path, 0}, kind.empty() ? problem : "is " + kind,
                             "take it out of the source folder, build the program and make the report again");
        }
        contents["source/" + file.path] = file.bytes;
    }
}

/// For `sha256sum -c`.
std::string manifest_of(const Contents& contents) {
    std::string manifest;
    for (const auto& [path, bytes] : contents) manifest += sha256(bytes) + "  " + path + "\n";
    return manifest;
}

std::vector<ZipEntry> entries_of(const Contents& contents) {
    std::vector<ZipEntry> entries;
    for (const auto& [path, bytes] : contents) entries.push_back({path, bytes, path.starts_with("source/") && is_script(bytes)});
    return entries;
}

}   // namespace

Submission pack(const ReportFolder& report, const SourceListing& listing, const SubmissionOptions& options) {
    const ReportFacts facts = require_ready(report, listing, options);
    const std::vector<SourceFile> tree = source_tree();
    Contents contents;
    for (const auto& [path, bytes] : report.files) {
        if (is_packed(path, options)) contents[path] = bytes;
    }
    enter_source(tree, contents);
    contents["LICENSE"] = contents.at("source/LICENSE");
    contents["NOTICES.md"] = contents.at(std::string("source/") + notices_source);
    const std::string how_to = instructions(facts, listing, tree, options);
    contents["INSTRUCTIONS.md"] = how_to;
    const std::string manifest = manifest_of(contents);
    contents[manifest_file] = manifest;
    return {zip_of(entries_of(contents)), contents.size(), facts.warnings};
}

std::string publish(const ReportFolder& report, const Submission& submission) {
    output::Publication publication(report.path);
    for (const auto& [path, bytes] : report.files) {   // as they were checked, whatever has happened to the folder since
        if (path == archive_file) continue;
        output::make_folder((publication.folder() / path).parent_path());
        write_file(publication.folder() / path, bytes);
    }
    write_file(publication.folder() / archive_file, submission.zip);
    return publication.publish();
}

}   // namespace meshfolio::submission
