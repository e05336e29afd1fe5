/// @file
/// `meshfolio mark`: a class against a rubric, into a folder that appears all at once.
#pragma once

#include <string>
#include <vector>

#include "base/errors.h"

namespace meshfolio::run {

struct MarkFlags {
    std::vector<std::string> submissions;   // folders and zips
    std::string rubric, out, templates;     // empty: the bundled example, marks, those of the program
};

/// @return failed when a submission could not be marked: its row says why, the others are marked
/// @throws SettingsErrors, InputError for a submission, a rubric or a mesh that is not there, OutputError
ExitCode mark_class(const MarkFlags& flags);

}   // namespace meshfolio::run
