#include "submission/report_folder.h"

#include "base/file_bytes.h"
#include "base/sha256.h"
#include "output/publish/publish.h"
#include "submission/suspicious_file.h"

namespace meshfolio::submission {

namespace fs = std::filesystem;

namespace {

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

/// Every file of the folder, none of them suspicious.
std::map<std::string, std::string> harmless_files(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {   // does not follow links
        if (fs::is_directory(entry.symlink_status())) continue;
        const std::string path = entry.path().lexically_relative(folder).generic_string();
        require_harmless(entry.path(), path, entry.symlink_status());
        std::string bytes = read_file(entry.path());
        if (const std::string kind = program_kind(bytes); !kind.empty()) refuse(entry.path(), "is " + kind, "take it out of the folder");
        files.emplace(path, std::move(bytes));
    }
    return files;
}

void require_sums(const fs::path& folder, const std::map<std::string, std::string>& files) {
    const fs::path sums_path = folder / output::sums_file;
    const auto text = files.find(output::sums_file);
    if (text == files.end()) refuse(sums_path, "is not there", renew);
    const auto sums = output::parse_sums(text->second, sums_path);
    for (const auto& [path, sum] : sums) {
        if (is_apart(path)) continue;
        if (const std::string problem = path_problem(path); !problem.empty())
            refuse(sums_path, "'" + path + "' " + problem, renew, sum.line);
        const auto file = files.find(path);
        if (file == files.end()) refuse(sums_path, path + " is listed and not there", renew, sum.line);
        if (sha256(file->second) != sum.digest) refuse(folder / path, "was changed after the report was written", renew);
    }
    for (const auto& [path, bytes] : files)
        if (!is_apart(path) && !sums.contains(path)) refuse(folder / path, "is no part of the report", "take it out of the folder");
}

}   // namespace

ReportFolder read_report(const fs::path& folder) try {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        refuse(folder, "is not a folder", "make a report with meshfolio report --out " + folder.string() + ", or name another with --out");
    if (!fs::exists(folder / output::marker_file, error))
        refuse(folder, "holds no report of meshfolio", "make one with meshfolio report --out " + folder.string());
    ReportFolder report{folder, harmless_files(folder)};
    require_sums(folder, report.files);
    for (const char* apart : {output::marker_file, output::sums_file, ".gitignore"}) report.files.erase(apart);
    return report;
} catch (const fs::filesystem_error& error) {
    throw InputError({folder.string(), 0}, "cannot be read (" + error.code().message() + ")");
}

}   // namespace meshfolio::submission
