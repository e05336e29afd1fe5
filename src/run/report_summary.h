/// @file
/// What a report did not achieve, in a few lines for the terminal.
#pragma once

#include "base/errors.h"
#include "report/document.h"

namespace meshfolio::run {

/// Warnings, failures, failed checks and the number of undecided ones, on stderr.
/// @return failed when a section or a check has failed; what is undecided is no failure
ExitCode summarise(const report::Document& document);

}   // namespace meshfolio::run
