#include "submission/submission.h"

#include <archive.h>
#include <archive_entry.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/joined.h"
#include "base/sha256.h"
#include "output/publish/folder_system.h"
#include "report/escape.h"
#include "report/numbering.h"
#include "report/page/template_render.h"
#include "report/writers.h"

namespace meshfolio::submission {

namespace {

using nlohmann::json;

constexpr const char* archive_file = "submission.zip";
constexpr std::string_view packages_script = "tests/setup.sh";   // which build-report needs too

/// The files of the archive: path → bytes.
using Contents = std::map<std::string, std::string_view>;

/// @throws OutputError with libarchive's reason unless `code` is ARCHIVE_OK
void require(int code, archive* writer) {
    if (code == ARCHIVE_OK) return;
    const char* reason = archive_error_string(writer);
    throw OutputError(archive_file, std::string("cannot be packed (") + (reason ? reason : "libarchive failed") + ")");
}

la_ssize_t append(archive*, void* zip, const void* bytes, std::size_t count) {
    static_cast<std::string*>(zip)->append(static_cast<const char*>(bytes), count);
    return static_cast<la_ssize_t>(count);
}

/// Returns the archive, deflated, sorted by path, without owners and times (readers show 1 January 1980): equal contents give equal bytes.
/// @throws OutputError if libarchive cannot
std::string zip_of(const Contents& contents) {
    std::string zip;
    const std::unique_ptr<archive, decltype(&archive_write_free)> owner(archive_write_new(), &archive_write_free);
    archive* const writer = owner.get();
    require(archive_write_set_format_zip(writer), writer);
    require(archive_write_set_options(writer, "zip:compression=deflate,zip:compression-level=6"), writer);
    require(archive_write_set_bytes_in_last_block(writer, 1), writer);   // no padding
    require(archive_write_open(writer, &zip, nullptr, append, nullptr), writer);
    for (const auto& [path, bytes] : contents) {
        // No time: libarchive would write the local one beside it, which differs with the time zone.
        const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(), &archive_entry_free);
        archive_entry_set_pathname(entry.get(), path.c_str());
        archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
        archive_entry_set_filetype(entry.get(), AE_IFREG);
        archive_entry_set_perm(entry.get(), path.starts_with("source/") && is_script(bytes) ? 0755 : 0644);
        archive_entry_set_uid(entry.get(), 0);
        archive_entry_set_gid(entry.get(), 0);
        require(archive_write_header(writer, entry.get()), writer);
        const la_ssize_t written = archive_write_data(writer, bytes.data(), bytes.size());
        require(written == static_cast<la_ssize_t>(bytes.size()) ? ARCHIVE_OK : ARCHIVE_FATAL, writer);
    }
    require(archive_write_close(writer), writer);
    return zip;
}

/// Renders templates/instructions.md: the contents of the archive, its build, and the place of each answer.
std::string instructions(const ReadyReport& ready, const std::vector<SourceFile>& tree, const SubmissionOptions& options) {
    const auto setup = std::ranges::find(tree, packages_script, &SourceFile::path);
    const report::Document& document = ready.document;
    const std::vector<std::string> numbers = report::section_numbers(document);
    json citations = json::array();
    for (std::size_t s = 0; s < numbers.size(); ++s) {
        const std::string label = (report::is_question(document.sections[s].id) ? "Q" : "") + numbers[s];
        for (const report::CodeReference& code : document.sections[s].code)
            citations.push_back(
                {{"section", label}, {"line", std::to_string(code.line)}, {"function", code.function}, {"file", code.file}});
    }
    const std::string& commit = document.provenance.commit;
    const bool has_own_meshes = std::ranges::any_of(document.sections, [](const report::Section& section) {
        return report::is_question(section.id) &&
               std::ranges::any_of(section.inputs, [](const report::Input& i) { return !i.asked.empty() && !i.stand_in; });
    });
    const json model = {{"title", report::safe_text(document.title)},
                        {"author", report::safe_text(ready.author)},
                        {"course", report::safe_text(document.course)},
                        {"has_course", !document.course.empty()},
                        {"version", document.provenance.version},
                        {"commit", commit},
                        {"has_commit", !commit.empty() && commit != "unknown"},
                        {"has_pdf", options.pdf},
                        {"has_images", options.images},
                        {"has_tests", options.tests},
                        {"has_own_meshes", has_own_meshes || document.provenance.settings.contains("meshes")},
                        {"packages", joined(build_packages(setup == tree.end() ? std::string_view() : setup->bytes), " ")},
                        {"citations", citations}};
    return report::render(report::Templates(), "instructions.md", model, report::markdown_escape);
}

bool is_packed(const std::string& path, const SubmissionOptions& options) {
    if (path == archive_file) return false;   // of an earlier submission
    if (path == "report.pdf" || path == "appendix.pdf") return options.pdf;
    if (path == "report.md" || path == "appendix.md" || path.starts_with("images/")) return options.images;
    return true;
}

}   // namespace

Submission pack(const ReportFolder& report, const SourceListing& listing, const SubmissionOptions& options) {
    const ReadyReport ready = require_ready(report, listing, options);
    const std::vector<SourceFile> tree = source_tree();
    Contents contents;
    for (const auto& [path, bytes] : report.files)
        if (is_packed(path, options)) contents[path] = bytes;
    for (const SourceFile& file : tree) {   // our own scripts are its only executables
        const bool is_test = file.path == "run-tests" || (file.path.starts_with("tests/") && file.path != packages_script);
        if (is_test && !options.tests) continue;
        const std::string kind = is_script(file.bytes) ? "" : program_kind(file.bytes), problem = path_problem(file.path);
        if (!kind.empty() || !problem.empty()) {
            throw InputError({"source/" + file.path}, kind.empty() ? problem : "is " + kind,
                             "take it out of the source folder, build the program and make the report again");
        }
        contents["source/" + file.path] = file.bytes;
    }
    contents["LICENSE"] = contents.at("source/LICENSE");
    contents["NOTICES.md"] = contents.at("source/src/submission/NOTICES.md");
    const std::string how_to = instructions(ready, tree, options);
    contents["INSTRUCTIONS.md"] = how_to;
    std::string manifest;   // for sha256sum -c
    for (const auto& [path, bytes] : contents) manifest += sha256(bytes) + "  " + path + "\n";
    contents["MANIFEST.sha256"] = manifest;
    return {zip_of(contents), contents.size(), ready.warnings};
}

output::Notes publish(const ReportFolder& report, const Submission& submission) {
    output::Publication publication(report.path);
    for (const auto& [path, bytes] : report.files) {   // as they were checked, even if the folder has changed since
        if (path == archive_file) continue;
        output::make_folder((publication.folder() / path).parent_path());
        write_file(publication.folder() / path, bytes);
    }
    write_file(publication.folder() / archive_file, submission.zip);
    return publication.publish();
}

}   // namespace meshfolio::submission
