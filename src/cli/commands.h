/// @file
/// The subcommands, one file each (<name>_command.cpp). A new one is a function here and a line in the table of cli.cpp. CLI11, whose
/// headers take seconds to compile, is included by cli.cpp and help_formats.cpp alone.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/errors.h"

namespace CLI {
class App;
}

namespace meshfolio {
struct Backend;
namespace run {}
}   // namespace meshfolio

namespace meshfolio::cli {

using namespace run;   // what the commands share with `report`

/// Puts what follows a command into variables, which must outlive the parsing. Names are as in CLI11: "MESH" is positional,
/// "-o,--output FILE" an option and what it takes, a NUMBER where nothing is said. A variable that is not empty keeps its value as the
/// default, which the help shows.
class CommandOptions {
public:
    CommandOptions(CLI::App& parent, const std::string& command, const std::string& purpose);

    void text(const std::string& names, std::string& value, const std::string& help);
    void required(const std::string& names, std::string& value, const std::string& help);
    /// One of the words; another is refused with the nearest of them.
    void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices, const std::string& help);
    void required_texts(const std::string& names, std::vector<std::string>& values, const std::string& help);
    /// A positional argument takes all words that follow, an option one word each time.
    void texts(const std::string& names, std::vector<std::string>& values, const std::string& help);
    void flag(const std::string& names, bool& value, const std::string& help);
    /// What the help ends with: an example.
    void footer(const std::string& text);

    operator CLI::App*() const { return app_; }

private:
    CLI::App* app_;
};

struct Command {
    CLI::App* app;                   // its options; parsed() if it was asked for
    std::function<ExitCode()> run;   // throws an Error, or returns ok or failed
};

/// Calls work with the backend of that name. `slepc` is the ranks of MPI: the first does the work, the others serve it.
/// @throws EngineError for what this program was built without
ExitCode with_backend(const std::string& backend, const std::function<ExitCode(const Backend&)>& work);
const std::vector<std::string>& backend_choices();

Command report_command(CLI::App& parent);
Command merge_command(CLI::App& parent);
Command batch_command(CLI::App& parent);
Command render_command(CLI::App& parent);
Command inspect_command(CLI::App& parent);
Command curvature_command(CLI::App& parent);
Command spectrum_command(CLI::App& parent);
Command smooth_command(CLI::App& parent);
Command noise_command(CLI::App& parent);
Command compare_command(CLI::App& parent);
Command lab_command(CLI::App& parent);
Command sample_command(CLI::App& parent);
Command list_command(CLI::App& parent);
Command doctor_command(CLI::App& parent);
Command verify_command(CLI::App& parent);
Command submit_command(CLI::App& parent);
Command cache_command(CLI::App& parent);
Command templates_command(CLI::App& parent);
Command help_command(CLI::App& parent);
Command version_command(CLI::App& parent);
Command mark_command(CLI::App& parent);

}   // namespace meshfolio::cli
