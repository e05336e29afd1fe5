#include <algorithm>

#include "base/lower_case.h"
#include "cli/render_flags.h"
#include "run/console.h"
#include "run/one_mesh/terminal_figure.h"

namespace meshfolio::cli {

using namespace run;

void keep_inputs(output::FileGroup& files, const RenderFlags& options) {
    for (const std::string& mesh : options.meshes) files.keep(mesh);
    files.keep(options.values.substr(0, options.values.rfind(':')));
    files.keep(options.colormap);
}

ExitCode run_figure(const RenderFlags& options) {
    const FigureStyle style = figure_style(options);
    if (!style.colors.warning.empty()) warn(style.colors.warning);
    if (!options.terminal) check_output("-o", options.output, {".pdf", ".svg", ".png"});
    const TerminalRoom room = options.terminal ? terminal_room() : TerminalRoom();
    std::vector<std::string> fields = split(options.field, ',');
    require_figure_fields(fields);
    const bool needs_all = std::ranges::any_of(fields, [](const std::string& name) { return checks_for(name) == Checks::all; });
    std::vector<PreparedMesh> meshes;
    for (const std::string& file : options.meshes) meshes.push_back(load_mesh(file, needs_all ? Checks::all : Checks::for_pictures));
    if (!options.values.empty()) fields.clear();
    std::vector<FigureMesh> figure = figure_meshes(meshes, labels_of(meshes), fields);
    if (!options.values.empty()) figure[0].fields = {field_from_file(meshes[0], options.values)};
    if (options.terminal) {
        print(terminal_figure(figure, style, room));
        return ExitCode::ok;
    }
    output::FileGroup files;
    keep_inputs(files, options);
    files.add(options.output, encode_figure(figure, style, lower_case_ending(options.output)));
    files.publish();
    print_path(options.output);
    return ExitCode::ok;
}

}   // namespace meshfolio::cli
