/// @file
/// Files that must not be in a submission: programs, build products, paths that lead outside.
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::submission {

/// Returns the kind of program that begins with these bytes: "an ELF program or library", "a script"; empty: no program.
std::string program_kind(std::string_view bytes);

/// True if the bytes begin with "#!". The project's own scripts (build-report, run-tests, …) are the only executables of a submission.
bool is_script(std::string_view bytes);

/// Returns why a path must not be packed ("leads outside its folder", "lies in a build folder", …); empty: it may.
std::string path_problem(std::string_view path);

}   // namespace meshfolio::submission
