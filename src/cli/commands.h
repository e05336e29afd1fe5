/// @file
/// The subcommands, one file each (<name>_command.cpp). A new one is a function here and a line in the table of cli.cpp. Only cli.cpp and
/// help_formats.cpp include CLI11, because its headers take seconds to compile.
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
namespace run {
struct ReportFlags;
struct SightFlags;
}   // namespace run
}   // namespace meshfolio

namespace meshfolio::cli {

using namespace run;

/// Adds a command whose arguments are stored in variables, which must outlive the parsing. Names are as in CLI11: "MESH" is a positional
/// argument, "-o,--output FILE" an option with the type of its value, which is NUMBER by default. The help shows the value of a variable
/// that is not empty as the default.
class CommandOptions {
public:
    CommandOptions(CLI::App& parent, const std::string& command, const std::string& purpose);

    void text(const std::string& names, std::string& value, const std::string& help);
    void required(const std::string& names, std::string& value, const std::string& help);
    /// Adds an argument that is one of `choices`; another word is refused, with the nearest choice as a suggestion.
    void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices, const std::string& help);
    void required_texts(const std::string& names, std::vector<std::string>& values, const std::string& help);
    /// Adds an argument with several values: a positional one takes all words that follow, an option one word each time it is given.
    void texts(const std::string& names, std::vector<std::string>& values, const std::string& help);
    void flag(const std::string& names, bool& value, const std::string& help);
    /// Sets the end of the help, such as an example.
    void footer(const std::string& text);

    operator CLI::App*() const { return app_; }

private:
    CLI::App* app_;
};

struct Command {
    CLI::App* app;                   // its options; parsed() is true for the command that was called
    std::function<ExitCode()> run;   // throws an Error, or returns ok or failed
};

/// Declares the options that report, batch and merge share: author, settings, templates, PDF.
void add_paper_options(CommandOptions& app, ReportFlags& flags);
/// Declares --camera, --up and --zoom.
void add_sight_options(CommandOptions& app, SightFlags& flags);
/// Declares the options that report and batch share: sections, time, size, sight, threads, cache.
void add_run_options(CommandOptions& app, ReportFlags& flags);

/// Returns work(), called with the backend "builtin" or "slepc". With slepc, the first rank of MPI calls work(); each other rank serves it
/// and returns ok.
/// @throws EngineError for slepc if this program was built without it
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
Command diff_command(CLI::App& parent);
Command show_command(CLI::App& parent);
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
