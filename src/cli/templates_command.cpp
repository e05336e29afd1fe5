#include <filesystem>
#include <map>
#include <memory>

#include "cli/commands.h"
#include "output/publish/file_group.h"
#include "output/publish/folder_system.h"
#include "report/writers.h"
#include "run/console.h"
#include "submission/source_listing.h"

namespace meshfolio::cli {

namespace {

namespace fs = std::filesystem;

struct TemplatesFlags {
    std::string folder;
    bool tags = false, pandoc = false, force = false;
};

/// Returns the templates of the report: name → text.
std::map<std::string, std::string> report_templates() {
    const report::Templates templates;
    std::map<std::string, std::string> files;
    for (const std::string& name : templates.names()) files[name] = templates[name];
    return files;
}

/// Returns the filter of Pandoc, and the extension of Quarto that contains it.
std::map<std::string, std::string> pandoc_filter() {
    const std::string folder = "templates/pandoc/", filter = "meshfolio.lua";
    std::map<std::string, std::string> files;
    for (const submission::SourceFile& file : submission::source_tree())
        if (file.path.starts_with(folder)) files[file.path.substr(folder.size())] = file.bytes;
    files["_extensions/meshfolio/" + filter] = files.at(filter);
    return files;
}

/// Writes all files, or none if one exists already.
void export_files(const std::map<std::string, std::string>& contents, const fs::path& folder, bool force) {
    for (const auto& [name, text] : contents) {
        std::error_code error;
        if (!force && fs::exists(folder / name, error))
            throw OutputError((folder / name).string(), "is there already", "choose another folder, or --force to replace it");
    }
    output::FileGroup files;
    for (const auto& [name, text] : contents) {
        output::make_folder((folder / name).parent_path());
        files.add(folder / name, text);
    }
    files.publish();
    for (const auto& [name, text] : contents) print_path(folder / name);
}

}   // namespace

Command templates_command(CLI::App& parent) {
    const auto flags = std::make_shared<TemplatesFlags>();
    CommandOptions app(parent, "templates", "The templates of the report, to be changed; a filter of Pandoc");
    app.text("DIR", flags->folder, "folder to write them into");
    app.flag("--pandoc", flags->pandoc, "instead meshfolio.lua, the filter of Pandoc, and _extensions/meshfolio, the extension of Quarto");
    app.flag("--tags", flags->tags, "print the meaning of every tag");
    app.flag("--force", flags->force, "replace existing files");
    app.footer(
        "Example: meshfolio templates mine && meshfolio report --templates mine\n"
        "         meshfolio templates --pandoc . && pandoc --lua-filter meshfolio.lua scan.md -o scan.html");
    return {app, [flags] {
                if (flags->tags == !flags->folder.empty())
                    throw UsageError("name either a folder or --tags", "see meshfolio templates --help");
                if (flags->tags) print(report::tag_documentation());
                else export_files(flags->pandoc ? pandoc_filter() : report_templates(), flags->folder, flags->force);
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
