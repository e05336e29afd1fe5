#include <memory>

#include "cli/commands.h"
#include "mesh/io/mesh_files.h"
#include "output/publish/file_group.h"
#include "report/writers.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/lab/lab_mesh.h"

namespace meshfolio::cli {

namespace {

struct LabFlags : SightFlags {
    std::string mesh, output, templates;
};

ExitCode run_lab(const LabFlags& options) {
    if (report::viewer_program().empty())
        throw UsageError("this program was built without the viewer, and the laboratory needs it", "apt install npm, then build again");
    check_output("-o", options.output, {".html", ".htm"});
    const render::Sight sight = sight_of(options);
    const report::Templates templates(options.templates);
    const PreparedMesh prepared = load_mesh(options.mesh);
    const std::string name = mesh_name(options.mesh);
    LabMesh lab = about_mesh(options.mesh, [&] {
        return lab_mesh(prepared.mesh, name, {{"lab", {}}}, {.vertices = 50'000, .decimated_to = 20'000});
    });
    lab.sight = sight;
    if (lab.is_decimated)
        warn(shown(options.mesh) + ": a page holds at most 50000 vertices, so it shows a copy of " +
             std::to_string(lab.mesh.vertex_count()));
    if (!lab.has_all_modes())
        warn(shown(options.mesh) + ": the page has the lowest " + std::to_string(lab.eigenvalues.size()) + " modes of " +
             std::to_string(lab.mesh.vertex_count()) + ", a truncation");
    output::FileGroup files;
    files.keep(options.mesh);
    files.add(options.output, report::write_lab_page(name, report::lab_of("lab", bytes_of(lab)), templates));
    files.publish();
    return ExitCode::ok;
}

}   // namespace

Command lab_command(CLI::App& parent) {
    const auto options = std::make_shared<LabFlags>();
    CommandOptions app(parent, "lab", "A page that filters the modes of one mesh live, for a lecture");
    app.required("MESH", options->mesh, formats_read);
    app.required("-o,--output FILE", options->output, "the page, one HTML file that works offline");
    add_sight_options(app, *options);
    app.text("--templates DIR", options->templates, "folder of templates that replace those of the same name");
    app.footer(
        "Up to 2,000 vertices the page has all modes, above the lowest 300 or fewer;\nbeyond 50,000 it shows a decimated copy of "
        "20,000.\nExample: "
        "meshfolio lab cube.obj -o lab.html");
    return {app, [options] { return run_lab(*options); }};
}

}   // namespace meshfolio::cli
