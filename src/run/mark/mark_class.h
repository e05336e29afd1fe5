/// @file
/// `meshfolio mark`: marks a class by a rubric, into a folder that appears all at once.
#pragma once

#include <string>
#include <vector>

#include "base/errors.h"

namespace meshfolio::run {

struct MarkFlags {
    std::vector<std::string> submissions;   // folders and zips
    std::string rubric, templates;          // empty: bundled
    std::string out;                        // folder of the marks
};

/// Marks all submissions and prints the path of class.csv.
/// @return failed if a submission could not be marked: its row says why
/// @throws SettingsErrors, OutputError; InputError for a submission, a rubric or a mesh that is missing
ExitCode mark_class(const MarkFlags& flags);

}   // namespace meshfolio::run
