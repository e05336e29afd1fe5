#include <memory>

#include "base/number_text.h"
#include "cli/commands.h"
#include "run/console.h"
#include "run/one_mesh/curvature_columns.h"
#include "run/one_mesh/fields.h"

namespace meshfolio::cli {

namespace {

std::string curvature_table(const PreparedMesh& prepared, const std::vector<NamedColumn>& columns) {
    std::string csv = "vertex,x,y,z,boundary";
    for (const NamedColumn& column : columns) csv += ',' + column.name;
    csv += '\n';
    for (int v = 0; v < prepared.mesh.vertex_count(); ++v) {
        csv += std::to_string(v);
        for (int axis = 0; axis < 3; ++axis) csv += ',' + exact_text(prepared.mesh.X(v, axis));
        csv += prepared.topology.on_boundary[static_cast<std::size_t>(v)] ? ",1" : ",0";
        for (const NamedColumn& column : columns) csv += ',' + exact_text(column.values[v]);
        csv += '\n';
    }
    return csv;
}

/// Interior vertices whose area is not positive have no curvature; that is worth a word.
void warn_of_empty_areas(const PreparedMesh& prepared, const std::string& file, AreaForm form) {
    const Vector areas = vertex_areas(prepared.mesh, form);
    int empty = 0;
    for (int v = 0; v < areas.size(); ++v) empty += prepared.topology.vertex_faces.size(v) > 0 && areas[v] <= 0 ? 1 : 0;
    if (empty > 0)
        warn(file + ": " + std::to_string(empty) + " vertices have no " + std::string(name_of(form)) + " area > 0; their cells are empty");
}

}   // namespace

Command curvature_command(CLI::App& parent) {
    struct Options {
        std::string mesh, area = "barycentric", laplacian = "cotan", csv = "-";
        bool jets = false;
    };
    const auto options = std::make_shared<Options>();
    CommandOptions app(parent, "curvature", "Areas and curvatures of every vertex as CSV");
    app.required("MESH", options->mesh, "OBJ, OFF, PLY or STL");
    app.choice("--area", options->area, {"barycentric", "voronoi", "mixed"}, "of a vertex");
    app.choice("--operator", options->laplacian, operator_choices(), "adds the mean curvature by another operator, as h_<its name>");
    app.flag("--jets", options->jets, "also h_jet and k_jet, of degree-3 polynomials fitted to two rings");
    app.text("--csv", options->csv, "file, or - for standard output");
    app.footer("Example: meshfolio curvature bunny.off --area mixed --csv bunny.csv");
    return {app, [options] {
                const AreaForm form = area_form_named(options->area);
                const OperatorKind kind = operator_named(options->laplacian);
                const PreparedMesh prepared = load_mesh(options->mesh);
                warn_of_empty_areas(prepared, options->mesh, form);
                output::FileGroup files;
                files.keep(options->mesh);
                print_to(files, options->csv, curvature_table(prepared, curvature_columns(prepared, form, kind, options->jets)));
                files.publish();
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
