/// @file
/// The subcommands, one file each (<name>_command.cpp). A new one is a function here and a line in the table of cli.cpp.
#pragma once

#include <functional>

#include "base/errors.h"
#include "cli/options.h"

namespace meshfolio::run {}

namespace meshfolio::cli {

using namespace run;   // what the commands share with `report`

struct Command {
    CLI::App* app;                   // its options; parsed() tells whether it was asked for
    std::function<ExitCode()> run;   // throws an Error, or returns ok or failed
};

Command report_command(CLI::App& parent);
Command render_command(CLI::App& parent);
Command inspect_command(CLI::App& parent);
Command curvature_command(CLI::App& parent);
Command spectrum_command(CLI::App& parent);
Command smooth_command(CLI::App& parent);
Command noise_command(CLI::App& parent);
Command compare_command(CLI::App& parent);
Command sample_command(CLI::App& parent);
Command list_command(CLI::App& parent);
Command doctor_command(CLI::App& parent);
Command verify_command(CLI::App& parent);
Command submit_command(CLI::App& parent);
Command cache_command(CLI::App& parent);
Command templates_command(CLI::App& parent);

}   // namespace meshfolio::cli
