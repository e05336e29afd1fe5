#include "submission/report_folder.h"

#include <algorithm>
#include <array>

#include "base/file_bytes.h"
#include "base/sha256.h"
#include "output/publish/publish.h"

namespace meshfolio::submission {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

struct Beginning {
    std::string_view bytes, kind;
};

constexpr std::array beginnings{
    Beginning{"\177ELF"sv, "an ELF program or library"},
    Beginning{"MZ"sv, "a Windows program"},
    Beginning{"\xfe\xed\xfa\xce"sv, "a Mach-O program"},
    Beginning{"\xfe\xed\xfa\xcf"sv, "a Mach-O program"},
    Beginning{"\xce\xfa\xed\xfe"sv, "a Mach-O program"},
    Beginning{"\xcf\xfa\xed\xfe"sv, "a Mach-O program"},
    Beginning{"\xca\xfe\xba\xbe"sv, "a Mach-O program or a Java class"},
    Beginning{"\0asm"sv, "a WebAssembly program"},
    Beginning{"!<arch>\n"sv, "a library"},
};

constexpr std::array build_folders{"build"sv, "CMakeFiles"sv, "node_modules"sv, "__pycache__"sv, ".git"sv};
constexpr std::array build_files{"CMakeCache.txt"sv, "build.ninja"sv, "Makefile"sv};
constexpr std::array build_endings{".o"sv, ".a"sv, ".so"sv, ".exe"sv, ".dll"sv, ".pyc"sv};

using Sums = std::map<std::string, output::FileSum>;

[[noreturn]] void refuse(const fs::path& file, const std::string& problem, const std::string& remedy, long line = 0) {
    throw InputError({file.string(), line}, problem, remedy);
}

/// True for the files of a report that its SHA256SUMS does not list.
bool is_unlisted(const std::string& path) { return path == output::sums_file || path == ".gitignore"; }

/// Reads a file that SHA256SUMS lists. @throws InputError if it has no place in a submission
std::string harmless_bytes(const fs::path& file, const std::string& path) {
    constexpr const char* remedy = "take it out of the folder";
    const fs::file_status status = fs::symlink_status(file);
    if (fs::is_symlink(status)) refuse(file, "is a link", remedy);
    if (const std::string problem = path_problem(path); !problem.empty()) refuse(file, problem, remedy);
    if (!fs::is_regular_file(status)) refuse(file, "is not a regular file", remedy);
    constexpr auto anyone = fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;
    if ((status.permissions() & anyone) != fs::perms::none)
        refuse(file, "is executable", "take the right away (chmod -x), or the file out");
    std::string bytes = read_file(file);
    if (const std::string kind = program_kind(bytes); !kind.empty()) refuse(file, "is " + kind, remedy);
    return bytes;
}

void require_sums(const fs::path& folder, const Sums& sums, const std::map<std::string, std::string>& files) {
    for (const auto& [path, sum] : sums) {
        if (is_unlisted(path)) continue;
        const fs::path sums_path = folder / output::sums_file;
        if (const std::string problem = path_problem(path); !problem.empty())
            refuse(sums_path, "'" + path + "' " + problem, renew, sum.line);
        const auto file = files.find(path);
        if (file == files.end()) refuse(sums_path, path + " is listed and not there", renew, sum.line);
        if (sha256(file->second) != sum.digest) refuse(folder / path, "was changed after the report was written", renew);
    }
}

}   // namespace

bool is_script(std::string_view bytes) { return bytes.starts_with("#!"); }

std::string program_kind(std::string_view bytes) {
    if (is_script(bytes)) return "a script";
    const auto found = std::ranges::find_if(beginnings, [&](const Beginning& b) { return bytes.starts_with(b.bytes); });
    return found == beginnings.end() ? "" : std::string(found->kind);
}

std::string path_problem(std::string_view path) {
    const auto is_plain = [](char c) { return c >= ' ' && c <= '~' && c != '\\'; };
    if (path.empty() || path.front() == '/' || !std::ranges::all_of(path, is_plain)) return "is no plain relative path";
    for (std::string_view rest = path; !rest.empty();) {
        const std::size_t end = std::min(rest.find('/'), rest.size());
        const std::string_view name = rest.substr(0, end);
        const bool last = end == rest.size();
        if (name.empty() || name == "." || name == "..") return "leads outside its folder";
        const auto is_name = [&](std::string_view word) { return name == word; };
        const auto ends = [&](std::string_view ending) { return name.ends_with(ending); };
        if (!last && std::ranges::any_of(build_folders, is_name)) return "lies in a build folder";
        if (last && (std::ranges::any_of(build_files, is_name) || std::ranges::any_of(build_endings, ends)))
            return "is what a build leaves";
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return "";
}

ReportFolder read_report(const fs::path& folder) try {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        refuse(folder, "is not a folder", "make a report with meshfolio report --out " + folder.string() + ", or name another with --out");
    if (!output::has_mark(folder, output::report_folder))
        refuse(folder, "holds no report of meshfolio", "make one with meshfolio report --out " + folder.string());
    const fs::path sums_path = folder / output::sums_file;
    if (!may_be_there(sums_path)) refuse(sums_path, "is not there", renew);
    const Sums sums = output::parse_sums(read_file(sums_path), sums_path);
    ReportFolder report{folder, {}, {}};
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {   // does not follow links
        if (fs::is_directory(entry.symlink_status())) continue;
        const std::string path = entry.path().lexically_relative(folder).generic_string();
        if (is_unlisted(path)) continue;
        if (sums.contains(path)) report.files.emplace(path, harmless_bytes(entry.path(), path));
        else report.others.push_back(path);
    }
    std::ranges::sort(report.others);
    require_sums(folder, sums, report.files);
    report.files.erase(output::marker_file);
    return report;
} catch (const fs::filesystem_error& error) {
    throw InputError({folder.string()}, "cannot be read (" + error.code().message() + ")", "check its rights");
}

}   // namespace meshfolio::submission
