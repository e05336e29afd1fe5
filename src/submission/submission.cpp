#include "submission/submission.h"

#include <archive.h>
#include <archive_entry.h>
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/joined.h"
#include "base/sha256.h"
#include "output/publish/folder_system.h"
#include "report/escape.h"
#include "report/page/template_render.h"
#include "report/writers.h"
#include "submission/source_listing.h"
#include "submission/suspicious_file.h"

namespace meshfolio::submission {

namespace {

struct ZipEntry {
    std::string path;
    std::string_view bytes;
    bool executable = false;   // mode 0755; else 0644
};

using Writer = std::unique_ptr<archive, decltype(&archive_write_free)>;
using Entry = std::unique_ptr<archive_entry, decltype(&archive_entry_free)>;

/// @throws OutputError with libarchive's reason
void require(int code, archive* writer) {
    if (code != ARCHIVE_OK) {
        const char* reason = archive_error_string(writer);
        throw OutputError("submission.zip", std::string("cannot be packed (") + (reason ? reason : "libarchive failed") + ")");
    }
}

la_ssize_t append(archive*, void* zip, const void* bytes, std::size_t count) {
    static_cast<std::string*>(zip)->append(static_cast<const char*>(bytes), count);
    return static_cast<la_ssize_t>(count);
}

void add(archive* writer, const ZipEntry& file) {
    // No time: libarchive would write the local one beside it, which differs with the time zone.
    const Entry entry(archive_entry_new(), &archive_entry_free);
    archive_entry_set_pathname(entry.get(), file.path.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(file.bytes.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), file.executable ? 0755 : 0644);
    archive_entry_set_uid(entry.get(), 0);
    archive_entry_set_gid(entry.get(), 0);
    require(archive_write_header(writer, entry.get()), writer);
    const la_ssize_t written = archive_write_data(writer, file.bytes.data(), file.bytes.size());
    require(written == static_cast<la_ssize_t>(file.bytes.size()) ? ARCHIVE_OK : ARCHIVE_FATAL, writer);
}

/// The archive, in the order of the entries, deflated, without owners and times (readers show 1 January 1980): its bytes depend on nothing
/// but its entries.
/// @throws OutputError if libarchive cannot
std::string zip_of(const std::vector<ZipEntry>& entries) {
    std::string zip;
    const Writer writer(archive_write_new(), &archive_write_free);
    archive* const w = writer.get();
    require(archive_write_set_format_zip(w), w);
    require(archive_write_set_options(w, "zip:compression=deflate,zip:compression-level=6"), w);
    require(archive_write_set_bytes_in_last_block(w, 1), w);   // no padding
    require(archive_write_open(w, &zip, nullptr, append, nullptr), w);
    for (const ZipEntry& entry : entries) add(w, entry);
    require(archive_write_close(w), w);
    return zip;
}

using nlohmann::json;

std::string packages_of(const std::vector<SourceFile>& tree) {
    const auto setup = std::find_if(tree.begin(), tree.end(), [](const SourceFile& f) { return f.path == "tests/setup.sh"; });
    return joined(build_packages(setup == tree.end() ? std::string_view() : setup->bytes), " ");
}

json citations_view(const SourceListing& listing) {
    json list = json::array();
    for (const CitingSection& section : listing.index()) {
        for (const report::CodeReference& code : section.code) {
            list.push_back(
                {{"section", section.label}, {"line", std::to_string(code.line)}, {"function", code.function}, {"file", code.file}});
        }
    }
    return list;
}

/// INSTRUCTIONS.md from templates/instructions.md: what the archive holds, how to build and run it, where each question is.
std::string instructions(const ReportFacts& facts, const SourceListing& listing, const std::vector<SourceFile>& tree,
                         const SubmissionOptions& options) {
    const json model = {{"title", report::safe_text(facts.title)},
                        {"author", report::safe_text(facts.author)},
                        {"course", report::safe_text(facts.course)},
                        {"has_course", !facts.course.empty()},
                        {"version", facts.version},
                        {"commit", facts.commit},
                        {"has_commit", !facts.commit.empty() && facts.commit != "unknown"},
                        {"has_pdf", options.pdf},
                        {"has_images", options.images},
                        {"has_own_meshes", facts.own_meshes},
                        {"packages", packages_of(tree)},
                        {"citations", citations_view(listing)}};
    return report::render(report::Templates(), "instructions.md", model, report::markdown_escape);
}

constexpr const char* archive_file = "submission.zip";
constexpr const char* manifest_file = "MANIFEST.sha256";
constexpr const char* notices_source = "src/submission/NOTICES.md";

/// Path in the archive → bytes.
using Contents = std::map<std::string, std::string_view>;

bool is_packed(const std::string& path, const SubmissionOptions& options) {
    if (path == archive_file) return false;   // of an earlier submission
    if (path == "report.pdf" || path == "appendix.pdf") return options.pdf;
    if (path == "report.md" || path == "appendix.md" || path.starts_with("images/")) return options.images;
    return true;
}

/// Adds the source tree. Our own scripts are its only executables; any other program or build product in it is refused.
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
    for (const auto& [path, bytes] : report.files)
        if (is_packed(path, options)) contents[path] = bytes;
    enter_source(tree, contents);
    contents["LICENSE"] = contents.at("source/LICENSE");
    contents["NOTICES.md"] = contents.at(std::string("source/") + notices_source);
    const std::string how_to = instructions(facts, listing, tree, options);
    contents["INSTRUCTIONS.md"] = how_to;
    const std::string manifest = manifest_of(contents);
    contents[manifest_file] = manifest;
    return {zip_of(entries_of(contents)), contents.size(), facts.warnings};
}

output::Notes publish(const ReportFolder& report, const Submission& submission) {
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
