/// @file
/// Help, man pages and completions, made from the definitions of the command line.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace meshfolio::cli {

/// Returns the command as the user types it: "meshfolio render".
std::string called(const CLI::App& command);

/// Returns the help of the program or of one command.
std::string help_text(const CLI::App& command);

/// Returns a page for man(1), of the program or of one command.
std::string man_page(const CLI::App& command);

/// Return a script for Bash, zsh or fish that completes commands, options and known values.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
std::string fish_completion(const CLI::App& program);

/// Returns the command of that name, or `program` itself for "". @throws UsageError for an unknown name, with the nearest
const CLI::App& command_called(const CLI::App& program, const std::string& name);

}   // namespace meshfolio::cli
