/// @file
/// The command line: arguments in, exit code out.
#pragma once

namespace meshfolio::cli {

/// Runs the command that the arguments name (`help` when there are none, `report` when options alone are given). Every error becomes one
/// line on stderr and its exit code.
int run(int argc, const char* const* argv);

}   // namespace meshfolio::cli
