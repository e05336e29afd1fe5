#include "cli/cli.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/joined.h"
#include "base/nearest_word.h"
#include "build_info.h"
#include "cli/commands.h"
#include "cli/help_formats.h"
#include "geometry/distributed/backend.h"
#include "geometry/distributed/ranks.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/progress.h"
#include "run/settings/report_settings.h"

namespace meshfolio::cli {

namespace {

struct CommandGroup {
    const char* title;
    std::vector<Command (*)(CLI::App&)> makers;
};
const CommandGroup groups[] = {
    {"Make a report", {report_command, show_command, batch_command, lab_command, merge_command, submit_command}},
    {"Work on a mesh",
     {inspect_command, render_command, curvature_command, spectrum_command, smooth_command, noise_command, sample_command}},
    {"Check and mark", {compare_command, diff_command, mark_command, verify_command}},
    {"Set up", {doctor_command, list_command, templates_command, cache_command, help_command, version_command}}};

/// Returns the words of the command line, with the command `help` if there are none, and `report` before options.
/// @throws UsageError for an empty word, often from an unset variable of a script: CLI11 would take the next word as the value of "--out="
std::vector<std::string> words_of(int argc, const char* const* argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty()) words.emplace_back("help");
    const bool asks_about_itself = words[0] == "-h" || words[0] == "--help" || words[0] == "--version";
    if (words[0].starts_with('-') && !asks_about_itself) words.insert(words.begin(), "report");
    std::string before;
    for (const std::string& word : words) {
        if (word.empty())
            throw UsageError("an argument is empty" + (before.empty() ? "" : ", the one after '" + before + "'"), "leave it out");
        if (word.starts_with("--") && word.find('=') == word.size() - 1)
            throw UsageError("'" + word + "' has no value", "write a value after '=', or leave the option out");
        before = word;
    }
    return words;
}

/// Returns an error of CLI11 as a UsageError that points to the help of the command. A misspelt option is reported first, as it often
/// causes the other problems.
/// @param name_called  by the user: "meshfolio" alone may mean the report
UsageError usage_error(const CLI::App& command, const std::string& name_called, const CLI::ParseError& error) {
    const std::string help = "see " + called(command) + " --help";
    std::vector<std::string> known;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    const std::vector<std::string> left = command.remaining();
    for (const std::string& word : left) {
        const std::string name = word.substr(0, word.find('='));
        if (name.starts_with('-')) return UsageError(name_called + " has no option '" + name + "'", suggestion(name, known) + help);
    }
    if (!left.empty()) return UsageError("'" + left.front() + "' is one argument too many", help);
    return UsageError(error.what(), help);
}

/// Adds an option such as "--out DIR": its names, and the type of its value, NUMBER by default. Positional arguments have no type.
template <class Value> CLI::Option* added(CLI::App& app, const std::string& names, Value& value, const std::string& help) {
    const std::size_t blank = std::min(names.find(' '), names.size());
    const std::string type = blank < names.size() ? names.substr(blank + 1) : names.starts_with('-') ? "NUMBER" : "";
    CLI::Option* option = app.add_option(names.substr(0, blank), value, help)->type_name(type);
    return value.empty() ? option : option->capture_default_str();
}

ExitCode parse_and_run(int argc, const char* const* argv) {
    CLI::App app("Answers the questions of the curvature-and-smoothing coursework on real meshes and writes the report.", "meshfolio");
    const std::string version = std::string("meshfolio ") + build_info::version;
    app.set_version_flag("--version", version);
    app.require_subcommand(0, 1);
    app.footer(
        "Begin with\n    meshfolio report --quick\nwhich answers every question on the bundled meshes and writes out/index.html.\n"
        "Each command explains itself: meshfolio help render");
    std::vector<Command> commands;
    for (const CommandGroup& group : groups) {
        for (const auto make : group.makers) {
            commands.push_back(make(app));
            commands.back().app->group(group.title)->set_version_flag("--version", version);
        }
    }

    std::vector<std::string> words = words_of(argc, argv);
    if (!words.front().starts_with('-')) command_called(app, words.front());   // throws for an unknown command
    std::ranges::reverse(words);                                               // CLI11 takes the words from the back
    try {
        app.parse(words);
    } catch (const CLI::CallForAllHelp&) {
        print(app.help("", CLI::AppFormatMode::All));
        return ExitCode::ok;
    } catch (const CLI::CallForHelp&) {
        const auto chosen = app.get_subcommands();
        print(help_text(chosen.empty() ? app : *chosen.front()));
        return ExitCode::ok;
    } catch (const CLI::CallForVersion& asked) {
        print(std::string(asked.what()) + "\n");
        return ExitCode::ok;
    } catch (const CLI::ParseError& error) {
        const auto chosen = app.get_subcommands();
        const CLI::App& command = chosen.empty() ? app : *chosen.front();
        throw usage_error(command, argc > 1 && argv[1][0] == '-' ? app.get_name() : called(command), error);
    }
    const auto chosen = std::ranges::find_if(commands, [](const Command& command) { return command.app->parsed(); });
    const Stage stage(chosen->app->get_name());
    return chosen->run();
}

/// True if no memory was left for a thread, which oneTBB reports by its message alone.
bool is_shortage(const std::exception& error) {
    if (const auto* system = dynamic_cast<const std::system_error*>(&error))
        return system->code() == std::errc::resource_unavailable_try_again || system->code() == std::errc::not_enough_memory;
    return std::string_view(error.what()).starts_with("pthread_create");
}

/// Prints at most 38 problems: a file of another kind may have one on every line.
void print_problems(const std::vector<UsageError>& problems) {
    const std::size_t printed = std::min<std::size_t>(38, problems.size());
    for (std::size_t i = 0; i < printed; ++i) complain(problems[i].what(), Ink::red);
    if (printed < problems.size()) complain("… and " + std::to_string(problems.size() - printed) + " more problems");
}

}   // namespace

CommandOptions::CommandOptions(CLI::App& parent, const std::string& command, const std::string& purpose)
    : app_(parent.add_subcommand(command, purpose)) {}

void CommandOptions::text(const std::string& names, std::string& value, const std::string& help) { added(*app_, names, value, help); }

void CommandOptions::required(const std::string& names, std::string& value, const std::string& help) {
    added(*app_, names, value, help)->required();
}

void CommandOptions::choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
                            const std::string& help) {
    const auto check = [choices, names](const std::string& word) {
        require_choice(names, word, choices);
        return std::string();
    };
    added(*app_, names, value, help)->type_name(joined(choices, "|"))->check(check);
}

void CommandOptions::texts(const std::string& names, std::vector<std::string>& values, const std::string& help) {
    added(*app_, names, values, help)->allow_extra_args(!names.starts_with('-'));
}

void CommandOptions::required_texts(const std::string& names, std::vector<std::string>& values, const std::string& help) {
    added(*app_, names, values, help)->required();
}

void CommandOptions::flag(const std::string& names, bool& value, const std::string& help) { app_->add_flag(names, value, help); }

void CommandOptions::footer(const std::string& text) { app_->footer(text); }

const std::vector<std::string>& backend_choices() {
    static const std::vector<std::string> choices{"builtin", "slepc"};
    return choices;
}

ExitCode with_backend(const std::string& backend, const std::function<ExitCode(const Backend&)>& work) {
    if (backend != "slepc") return work({});
    const std::unique_ptr<Ranks> ranks = ranks_of_mpi();
    if (ranks->is_first()) return work(backend_of(*ranks));
    ranks->serve();
    return ExitCode::ok;
}

int run(int argc, const char* const* argv) {
    try {
        return static_cast<int>(parse_and_run(argc, argv));
    } catch (const SettingsErrors& errors) {
        print_problems(errors.problems());
        return static_cast<int>(errors.exit_code());
    } catch (const ReaderGone&) {
        end_by_broken_pipe();
    } catch (const Error& error) {
        complain(error.what(), Ink::red);
        return static_cast<int>(error.exit_code());
    } catch (const std::bad_alloc&) {
        complain("out of memory; use a smaller mesh, fewer modes or smaller pictures", Ink::red);
        return static_cast<int>(ExitCode::failed);
    } catch (const std::exception& error) {
        complain(is_shortage(error) ? std::string("out of memory: ") + error.what() + "; take fewer --threads"
                                    : std::string("internal error: ") + error.what() + "; please report it",
                 Ink::red);
        return static_cast<int>(ExitCode::failed);
    }
}

}   // namespace meshfolio::cli
