#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "output/publish/file_group.h"
#include "output/publish/folder_system.h"
#include "report/writers.h"
#include "run/console.h"

namespace meshfolio::cli {

namespace {

namespace fs = std::filesystem;

struct TemplatesFlags {
    std::string folder;
    bool tags = false, force = false;
};

/// Writes all templates, or none if a file exists already.
void export_templates(const fs::path& folder, bool force) {
    const report::Templates templates;
    for (const std::string& name : templates.names()) {
        std::error_code error;
        if (!force && fs::exists(folder / name, error))
            throw OutputError((folder / name).string(), "is there already", "choose another folder, or --force to replace it");
    }
    output::make_folder(folder);
    output::FileGroup files;
    for (const std::string& name : templates.names()) {
        output::make_folder((folder / name).parent_path());
        files.add(folder / name, templates[name]);
    }
    files.publish();
    for (const std::string& name : templates.names()) print_path(folder / name);
}

}   // namespace

Command templates_command(CLI::App& parent) {
    const auto flags = std::make_shared<TemplatesFlags>();
    CommandOptions app(parent, "templates", "The templates of the report, to be changed and used");
    app.text("DIR", flags->folder, "folder to write them into");
    app.flag("--tags", flags->tags, "print the meaning of every tag");
    app.flag("--force", flags->force, "replace existing files");
    app.footer("Example: meshfolio templates mine && meshfolio report --templates mine");
    return {app, [flags] {
                if (flags->tags == !flags->folder.empty())
                    throw UsageError("name either a folder or --tags", "see meshfolio templates --help");
                if (flags->tags) print(report::tag_documentation());
                else export_templates(flags->folder, flags->force);
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
