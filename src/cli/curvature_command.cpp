#include <cmath>
#include <memory>

#include "cli/commands.h"
#include "cli/console.h"
#include "geometry/curvature.h"
#include "geometry/mesh_operators.h"
#include "number_text.h"

namespace meshfolio::cli {

namespace {

std::string curvature_table(const PreparedMesh& prepared, AreaForm form) {
    const TriangleMesh& mesh = prepared.mesh;
    const MeshOperators operators = mesh_operators(mesh, prepared.topology, form);
    const Vector& areas = operators.areas(form);
    const Vector h_uniform = uniform_mean_curvature(mesh, prepared.topology);
    const Vector h_scaled = uniform_mean_curvature_scaled(mesh, prepared.topology);
    std::string csv = "vertex,x,y,z,boundary,area,h_uniform,k_gauss,h_cotan,h_uniform_scaled\n";
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        csv += std::to_string(v);
        for (int axis = 0; axis < 3; ++axis) csv += ',' + exact_text(mesh.X(v, axis));
        csv += prepared.topology.on_boundary[static_cast<std::size_t>(v)] ? ",1" : ",0";
        const double area = areas[v] > 0 ? areas[v] : std::nan("");
        for (const double value : {area, h_uniform[v], operators.K[v], operators.H[v], h_scaled[v]}) csv += ',' + exact_text(value);
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
        std::string mesh, area = "barycentric", csv = "-";
    };
    const auto options = std::make_shared<Options>();
    CLI::App* app = parent.add_subcommand("curvature", "Areas and curvatures of every vertex as CSV");
    app->add_option("MESH", options->mesh, "OBJ, OFF, PLY or STL")->required();
    app->add_option("--area", options->area, "barycentric, voronoi or mixed")->capture_default_str();
    app->add_option("--csv", options->csv, "file, or - for standard output")->capture_default_str();
    app->footer("Example: meshfolio curvature bunny.off --area mixed --csv bunny.csv");
    return {app, [options] {
                const AreaForm form = area_form_named(options->area);
                const PreparedMesh prepared = load_mesh(options->mesh);
                warn_of_empty_areas(prepared, options->mesh, form);
                print_to(options->csv, curvature_table(prepared, form));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
