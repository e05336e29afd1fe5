/// @file
/// What the command line's own definitions say of it: help, man pages, completions.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace meshfolio::cli {

/// "meshfolio render".
std::string called(const CLI::App& command);

std::string help_text(const CLI::App& command);

/// A page for man(1), of the program or of one command.
std::string man_page(const CLI::App& command);

/// Completions of the whole program, for the shell of that name.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
std::string fish_completion(const CLI::App& program);

/// The command of that name, `program` itself for an empty one. @throws UsageError when there is none, with the nearest
const CLI::App& command_called(const CLI::App& program, const std::string& name);

}   // namespace meshfolio::cli
