#include <algorithm>
#include <cmath>
#include <memory>

#include "base/joined.h"
#include "cli/commands.h"
#include "mesh/io/mesh_files.h"
#include "run/console.h"
#include "run/one_mesh/fields.h"

namespace meshfolio::cli {

namespace {

void warn_of_missing_jets(const PreparedMesh& prepared, const std::vector<VertexColumn>& columns, const std::string& file) {
    const auto jets = std::ranges::find(columns, "h_jet", &VertexColumn::name);
    const Preflight& p = prepared.preflight;
    const auto missing = jets->values.array().isNaN().count() - (p.vertices - p.vertices_in_use);
    if (missing > 0)
        warn(file + ": " + std::to_string(missing) + " of " + std::to_string(p.vertices_in_use) +
             " vertices have no jet: too few vertices around, or a sample too thin to be trusted");
}

/// Warns of vertices of triangles that have no area > 0, and therefore no curvature.
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
        std::string mesh, area = "barycentric", laplacian = "cotan", csv, ply;
        bool jets = false;
    };
    const auto options = std::make_shared<Options>();
    CommandOptions app(parent, "curvature", "Areas and curvatures of every vertex as CSV");
    app.required("MESH", options->mesh, formats_read);
    app.choice("--area", options->area, area_choices(), "area of a vertex");
    app.choice("--operator", options->laplacian, operator_choices(), "adds the mean curvature by another operator, as h_<its name>");
    app.flag("--jets", options->jets, "also h_jet and k_jet, of degree-3 polynomials fitted to two rings");
    app.text("--csv FILE", options->csv, "file, or - for standard output; default: - without --ply");
    app.text("--ply FILE", options->ply,
             "the mesh with all of these beside the values its vertices have: " + joined(column_endings(), ", "));
    app.footer("Example: meshfolio curvature bunny.off --area mixed --csv bunny.csv");
    return {app, [options] {
                const AreaForm form = area_form_named(options->area);
                const OperatorKind kind = operator_named(options->laplacian);
                check_output("--csv", options->csv, {".csv", "-"});
                check_output("--ply", options->ply, column_endings());
                const PreparedMesh prepared = load_mesh(options->mesh, Checks::all, options->ply.empty() ? Keep::mesh : Keep::attributes);
                warn_of_empty_areas(prepared, shown(options->mesh), form);
                output::FileGroup files;
                files.keep(options->mesh);
                const std::vector<VertexColumn> columns = curvature_columns(prepared, form, kind, options->jets);
                if (options->jets) warn_of_missing_jets(prepared, columns, shown(options->mesh));
                if (!options->ply.empty()) add_mesh(files, options->ply, prepared.mesh, attributes_with(prepared, columns));
                if (!options->csv.empty() || options->ply.empty())
                    print_to(files, options->csv.empty() ? "-" : options->csv, vertex_table(prepared, columns));
                files.publish();
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
