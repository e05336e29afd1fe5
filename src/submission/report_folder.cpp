#include "submission/report_folder.h"

#include <algorithm>
#include <utility>

#include "base/file_bytes.h"
#include "base/sha256.h"
#include "output/publish/publish.h"
#include "submission/suspicious_file.h"

namespace meshfolio::submission {

namespace fs = std::filesystem;

namespace {

using Sums = std::map<std::string, output::FileSum>;

[[noreturn]] void refuse(const fs::path& file, const std::string& problem, const std::string& remedy, long line = 0) {
    throw InputError({file.string(), line}, problem, remedy);
}

/// Neither listed in SHA256SUMS nor part of the report: the sums themselves and .gitignore.
bool is_apart(const std::string& path) { return path == output::sums_file || path == ".gitignore"; }

void require_harmless(const fs::path& file, const std::string& path, const fs::file_status& status) {
    constexpr const char* remedy = "take it out of the folder";
    if (fs::is_symlink(status)) refuse(file, "is a link", remedy);
    if (const std::string problem = path_problem(path); !problem.empty()) refuse(file, problem, remedy);
    if (!fs::is_regular_file(status)) refuse(file, "is not a regular file", remedy);
    constexpr auto anyone = fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;
    if ((status.permissions() & anyone) != fs::perms::none)
        refuse(file, "is executable", "take the right away (chmod -x), or the file out");
}

/// Reads the listed files, none of them suspicious; the paths of others go to `others`.
std::map<std::string, std::string> listed_files(const fs::path& folder, const Sums& sums, std::vector<std::string>& others) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {   // does not follow links
        if (fs::is_directory(entry.symlink_status())) continue;
        const std::string path = entry.path().lexically_relative(folder).generic_string();
        if (is_apart(path)) continue;
        if (!sums.contains(path)) {
            others.push_back(path);
            continue;
        }
        require_harmless(entry.path(), path, entry.symlink_status());
        std::string bytes = read_file(entry.path());
        if (const std::string kind = program_kind(bytes); !kind.empty()) refuse(entry.path(), "is " + kind, "take it out of the folder");
        files.emplace(path, std::move(bytes));
    }
    std::ranges::sort(others);
    return files;
}

Sums listed_sums(const fs::path& folder) {
    const fs::path file = folder / output::sums_file;
    if (!may_be_there(file)) refuse(file, "is not there", renew);
    return output::parse_sums(read_file(file), file);
}

void require_sums(const fs::path& folder, const Sums& sums, const std::map<std::string, std::string>& files) {
    for (const auto& [path, sum] : sums) {
        if (is_apart(path)) continue;
        const fs::path sums_path = folder / output::sums_file;
        if (const std::string problem = path_problem(path); !problem.empty())
            refuse(sums_path, "'" + path + "' " + problem, renew, sum.line);
        const auto file = files.find(path);
        if (file == files.end()) refuse(sums_path, path + " is listed and not there", renew, sum.line);
        if (sha256(file->second) != sum.digest) refuse(folder / path, "was changed after the report was written", renew);
    }
}

}   // namespace

ReportFolder read_report(const fs::path& folder) try {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        refuse(folder, "is not a folder", "make a report with meshfolio report --out " + folder.string() + ", or name another with --out");
    if (!output::has_mark(folder, output::report_folder))
        refuse(folder, "holds no report of meshfolio", "make one with meshfolio report --out " + folder.string());
    const Sums sums = listed_sums(folder);
    ReportFolder report{folder, {}, {}};
    report.files = listed_files(folder, sums, report.others);
    require_sums(folder, sums, report.files);
    report.files.erase(output::marker_file);
    return report;
} catch (const fs::filesystem_error& error) {
    throw InputError({folder.string(), 0}, "cannot be read (" + error.code().message() + ")");
}

}   // namespace meshfolio::submission
