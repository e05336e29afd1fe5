/// @file
/// What has no place in a submission: programs, build folders, links, paths that lead outside.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::submission {

/// What kind of program begins with these bytes: "an ELF program", "a script"; empty: none.
std::string program_kind(std::string_view bytes);

/// A script's first line. The project's own scripts (build-report, run-tests, …) have it, and are the only executables of a submission.
bool is_script(std::string_view bytes);

/// Why a relative path must not be packed: it leads outside, or names a build folder or what a build leaves; empty: it may.
std::string path_problem(std::string_view path);

}   // namespace meshfolio::submission
