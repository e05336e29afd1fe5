#include "cli/help_formats.h"

#include <CLI/CLI.hpp>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/nearest_word.h"
#include "base/terminal.h"
#include "build_info.h"
#include "questions/core/chapter.h"
#include "run/arguments.h"

namespace meshfolio::cli {

namespace {

/// Returns the options of a command in the order of their definition. @param places  its positional arguments instead
std::vector<const CLI::Option*> options_of(const CLI::App& command, bool places) {
    return command.get_options([places](const CLI::Option* option) { return option->get_positional() == places; });
}

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
    return program.get_subcommands([](const CLI::App*) { return true; });
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// Returns the names with their dashes: "-o", "--output".
std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    return text;
}

/// Returns the words that complete a value, by its type, with a space between; empty: any value.
std::string values_of(const CLI::App& program, const CLI::Option& option) {
    const std::string type = option.get_positional() ? option.get_name() : option.get_type_name();
    if (type == "COMMAND") {
        std::vector<std::string> names;
        for (const CLI::App* command : commands_of(program)) names.push_back(command->get_name());
        return joined(names, " ");
    }
    if (type == "NAME" && option.get_positional()) return "$(meshfolio sample --list | cut -d' ' -f1)";
    if (type == "VIEWS") return "+x -x +y -y +z -z hero";
    if (type == "QUESTIONS") return joined(section_ids(), " ");
    if (type == "SETTINGS") return joined(bundled_report_names(), " ");
    const std::string words = option.get_type_name();
    return words.find('|') == std::string::npos ? "" : replaced(words, "|", " ");
}

/// Returns text escaped for troff: dashes that can be copied, no line that begins with a control character.
std::string troff(const std::string& text) {
    std::string safe = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
    if (safe.starts_with('.') || safe.starts_with('\'')) safe.insert(0, "\\&");
    return replaced(replaced(safe, "\n.", "\n\\&."), "\n'", "\n\\&'");
}

std::string man_options(const CLI::App& command) {
    std::string text;
    for (const bool places : {true, false}) {
        for (const CLI::Option* option : options_of(command, places)) {
            text += ".TP\n";
            std::string names = places ? "\\fI" + troff(option->get_name()) + "\\fR" : "";
            for (const std::string& name : names_of(*option)) names += (names.empty() ? "\\fB" : ", \\fB") + troff(name) + "\\fR";
            if (!places && takes_value(*option))
                names += " \\fI" + replaced(troff(option->get_type_name()), "|", "|\\:") + "\\fR";   // \\: allows a line break
            text += names + "\n" + troff(option->get_description());
            if (!option->get_default_str().empty()) text += " (default: " + troff(option->get_default_str()) + ")";
            text += "\n";
        }
    }
    return text;
}

/// Returns text in single quotes. @param quote  how the shell writes a single quote within them
std::string single_quoted(const std::string& text, const std::string& quote) { return "'" + replaced(text, "'", quote) + "'"; }

}   // namespace

std::string called(const CLI::App& command) {
    return command.get_parent() == nullptr ? command.get_name() : called(*command.get_parent()) + " " + command.get_name();
}

// App::help() would return the help of the parsed command, which is `help` itself.
std::string help_text(const CLI::App& command) {
    command.get_formatter()->column_width(command.get_parent() == nullptr ? 14 : 30);   // one formatter serves all
    const std::string text = command.get_formatter()->make_help(&command, called(command), CLI::AppFormatMode::Normal);
    std::string shown;
    for (const std::string& line : run::split(for_terminal(text), '\n'))
        shown += (line.ends_with(':') && !line.starts_with(' ') ? inked(Ink::bold, line) : line) + "\n";
    shown.pop_back();
    return shown;
}

const CLI::App& command_called(const CLI::App& program, const std::string& name) {
    if (name.empty()) return program;
    std::vector<std::string> known;
    for (const CLI::App* command : commands_of(program)) {
        if (command->get_name() == name) return *command;
        known.push_back(command->get_name());
    }
    throw UsageError("unknown command " + in_quotes(name), suggestion(name, known) + "see meshfolio help");
}

std::string man_page(const CLI::App& command) {
    const bool is_program = command.get_parent() == nullptr;
    const std::string title = troff(replaced(called(command), " ", "-"));
    std::string text = ".TH \"" + title + "\" 1 \"\" \"meshfolio " + build_info::version + "\" \"User Commands\"\n.ad l\n.SH NAME\n" +
                       title + " \\- " + troff(command.get_description()) + "\n.SH SYNOPSIS\n.B " + troff(called(command)) +
                       (is_program ? "\n.I COMMAND\n[\\fIOPTIONS\\fR]" : "\n[\\fIOPTIONS\\fR]");
    for (const CLI::Option* place : options_of(command, true))
        text += place->get_required() ? " \\fI" + place->get_name() + "\\fR" : " [\\fI" + place->get_name() + "\\fR]";
    if (is_program) {
        text += "\n.SH COMMANDS\n";
        for (const CLI::App* one : commands_of(command))
            text += ".TP\n\\fB" + troff(one->get_name()) + "\\fR\n" + troff(one->get_description()) + "\n";
    }
    text += "\n.SH OPTIONS\n" + man_options(command) + ".SH NOTES\n.nf\n" + troff(command.get_footer()) + "\n.fi\n";
    text +=
        ".SH EXIT STATUS\n"
        "0 all well; 1 a question or a check failed, and the report says so; 2 wrong usage or settings; 3 an input is missing or "
        "unusable; 4 an output cannot be written; 5 a required engine is missing; 130 interrupted.\n";
    return text + (is_program ? ".SH SEE ALSO\nEach command has a page: \\fBmeshfolio\\-render\\fR(1), for one.\n"
                              : ".SH SEE ALSO\n\\fBmeshfolio\\fR(1)\n");
}

std::string bash_completion(const CLI::App& program) {
    std::string values, words;
    for (const CLI::App* command : commands_of(program)) {
        std::string names, places;
        for (const CLI::Option* option : options_of(*command, true)) places += values_of(program, *option);
        for (const CLI::Option* option : options_of(*command, false)) {
            std::string pattern;
            for (const std::string& name : names_of(*option)) {
                names += name + " ";
                pattern += (pattern.empty() ? "'" : " | '") + command->get_name() + " " + name + "'";
            }
            // Options with other values get no words, so that Bash completes names of files.
            if (takes_value(*option)) values += "    " + pattern + ") words=\"" + values_of(program, *option) + "\" ;;\n";
        }
        words += "    " + command->get_name() + ") [[ $word == -* ]] && words=\"" + names + "\" || words=\"" + places + "\" ;;\n";
    }
    std::string commands = "--help --version";
    for (const CLI::App* command : commands_of(program)) commands += " " + command->get_name();
    return "# bash completion of meshfolio, made by `meshfolio help --as bash`\n_meshfolio() {\n"
           "  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} words=\n"
           "  if ((COMP_CWORD == 1)); then words=\"" +
           commands + "\"\n  else case \"$command ${COMP_WORDS[COMP_CWORD - 1]}\" in\n" + values + "    *) case $command in\n" + words +
           "    esac ;;\n  esac; fi\n  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n}\n"
           "complete -o default -F _meshfolio meshfolio\n";
}

std::string zsh_completion(const CLI::App& program) {
    const auto escaped = [](const std::string& text) {
        return replaced(replaced(replaced(replaced(text, "\\", "\\\\"), "[", "\\["), "]", "\\]"), ":", "\\:");
    };
    const auto action = [&](const CLI::Option& option) {
        const std::string values = values_of(program, option), type = option.get_type_name();
        return ":" + escaped(type.empty() ? option.get_name() : type) + ":" +
               (!values.empty()    ? "(" + values + ")"
                : type == "DIR"    ? "_files -/"
                : type == "NUMBER" ? " "
                                   : "_files");
    };
    std::string names, cases;
    for (const CLI::App* command : commands_of(program)) {
        names += "    " + single_quoted(command->get_name() + ":" + escaped(command->get_description()), "'\\''") + "\n";
        cases += "    " + command->get_name() + ") _arguments";
        for (const CLI::Option* option : options_of(*command, false)) {
            for (const std::string& name : names_of(*option))
                cases += " \\\n      " + single_quoted("*" + name + "[" + escaped(option->get_description()) + "]" +
                                                           (takes_value(*option) ? action(*option) : ""),
                                                       "'\\''");
        }
        for (const CLI::Option* place : options_of(*command, true))
            cases += " \\\n      " + single_quoted((place->get_items_expected_max() > 1 ? "*" : "") + action(*place), "'\\''");
        cases += " ;;\n";
    }
    return "#compdef meshfolio\n# zsh completion of meshfolio, made by `meshfolio help --as zsh`\n_meshfolio() {\n  local -a commands=(\n" +
           names +
           "  )\n  if ((CURRENT == 2)); then _describe command commands; return; fi\n  shift words; ((CURRENT--))\n"
           "  case $words[1] in\n" +
           cases + "  esac\n}\n_meshfolio \"$@\"\n";
}

std::string fish_completion(const CLI::App& program) {
    std::string text = "# fish completion of meshfolio, made by `meshfolio help --as fish`\n";
    const auto quoted = [](const std::string& words) { return single_quoted(replaced(words, "\\", "\\\\"), "\\'"); };
    const auto given = [&](const CLI::Option& option) {
        const std::string values = values_of(program, option);
        return values.empty() ? std::string() : " -x -a " + quoted(values.starts_with('$') ? values.substr(1) : values);
    };
    for (const CLI::App* command : commands_of(program)) {
        text += "complete -c meshfolio -n __fish_use_subcommand -f -a " + command->get_name() + " -d " +
                quoted(command->get_description()) + "\n";
        const std::string begin = "complete -c meshfolio -n '__fish_seen_subcommand_from " + command->get_name() + "'";
        for (const CLI::Option* option : options_of(*command, false)) {
            text += begin;
            for (const std::string& name : option->get_snames()) text += " -s " + name;
            for (const std::string& name : option->get_lnames()) text += " -l " + name;
            text += (takes_value(*option) ? " -r" + given(*option) : "") + " -d " + quoted(option->get_description()) + "\n";
        }
        for (const CLI::Option* place : options_of(*command, true))
            if (const std::string values = given(*place); !values.empty()) text += begin + values + "\n";
    }
    return text;
}

}   // namespace meshfolio::cli
