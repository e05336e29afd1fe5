/// @file
/// A complete report, read from its folder and checked, and the files that must not be in a submission: programs, build products, paths
/// that lead outside.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"

namespace meshfolio::submission {

struct ReportFolder {
    std::filesystem::path path;
    std::map<std::string, std::string> files;   // relative path → bytes; without the marker, the sums and .gitignore
    std::vector<std::string> others;            // relative paths of the user's files, which SHA256SUMS does not list
};

/// Reads the report in a folder into memory, all files that its SHA256SUMS lists.
/// @throws InputError if there is no report of meshfolio, a file differs from SHA256SUMS, or a listed file is a program, a link or in a
/// build folder
ReportFolder read_report(const std::filesystem::path& folder);

/// Returns the kind of program that begins with these bytes, such as "an ELF program or library" or "a script"; empty: no program.
std::string program_kind(std::string_view bytes);

/// True if the bytes begin with "#!". The project's own scripts (build-report, run-tests, …) are the only executables of a submission.
bool is_script(std::string_view bytes);

/// Returns why a path must not be packed ("leads outside its folder", "lies in a build folder", …); empty: it may be packed.
std::string path_problem(std::string_view path);

inline constexpr const char* renew = "make the report again with meshfolio report";

/// A report that cannot be submitted: a question or a citation is missing.
class SubmissionError : public Error {
public:
    explicit SubmissionError(const std::string& file, const std::string& problem, const std::string& remedy)
        : Error(ExitCode::failed, {file, 0}, problem, remedy) {}
};

}   // namespace meshfolio::submission
