/// @file
/// A report as `meshfolio report` left it, read back whole and checked.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace meshfolio::submission {

struct ReportFolder {
    std::filesystem::path path;
    std::map<std::string, std::string> files;   // relative path → bytes; without the marker, the sums and .gitignore
};

/// @throws InputError if there is no report of ours, a file is not what SHA256SUMS says, or something is among them that has no place in
/// a report: a program, a link, a build folder
ReportFolder read_report(const std::filesystem::path& folder);

}   // namespace meshfolio::submission
