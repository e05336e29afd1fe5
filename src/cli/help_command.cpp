#include <memory>

#include "build_info.h"
#include "cli/commands.h"
#include "cli/help_formats.h"
#include "run/console.h"
#include "run/provenance.h"

namespace meshfolio::cli {

Command help_command(CLI::App& parent) {
    struct HelpFlags {
        std::string command, format = "text";
    };
    const auto flags = std::make_shared<HelpFlags>();
    CommandOptions app(parent, "help", "What the program can do, or how a command is used");
    app.text("COMMAND", flags->command, "a command; default: all of them in short");
    app.choice("--as", flags->format, {"text", "man", "bash", "zsh", "fish"}, "a page for man(1), or completions for a shell");
    app.footer("Example: meshfolio help render\n         source <(meshfolio help --as bash)");
    return {app, [flags, &parent] {
                const std::string& format = flags->format;
                print(format == "bash"   ? bash_completion(parent)
                      : format == "zsh"  ? zsh_completion(parent)
                      : format == "fish" ? fish_completion(parent)
                      : format == "man"  ? man_page(command_called(parent, flags->command))
                                         : help_text(command_called(parent, flags->command)));
                return ExitCode::ok;
            }};
}

Command version_command(CLI::App& parent) {
    const auto build = std::make_shared<bool>(false);
    CommandOptions app(parent, "version", "The version of the program");
    app.flag("--build", *build, "also a digest of the program, its libraries and the processor, which changes when results may");
    return {app, [build] {
                print(std::string("meshfolio ") + build_info::version + (*build ? " " + program_identity() : "") + "\n");
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
