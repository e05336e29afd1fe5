#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <vector>

#include "base/number_text.h"
#include "cli/commands.h"
#include "cli/fields.h"
#include "geometry/curvature/curvature.h"
#include "geometry/curvature/jet_fit.h"
#include "geometry/operators/laplace_operator.h"
#include "run/console.h"

namespace meshfolio::cli {

namespace {

struct NamedColumn {
    std::string name;
    Vector values;   // n; NaN is an empty cell
};

/// h_idt, h_cotan_no_half, …
NamedColumn operator_column(const PreparedMesh& prepared, AreaForm form, OperatorKind kind) {
    std::string name = "h_" + std::string(operator_entry(kind).name);
    std::replace(name.begin(), name.end(), '-', '_');
    const LaplaceBeltrami laplacian = laplace_operator(prepared.mesh, kind, form);
    return {name, operator_mean_curvature(prepared.mesh, prepared.topology, kind, laplacian)};
}

std::vector<NamedColumn> curvature_columns(const PreparedMesh& prepared, AreaForm form, OperatorKind kind, bool with_jets) {
    const auto& [mesh, topology] = std::tie(prepared.mesh, prepared.topology);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh, form);
    const Vector& areas = laplacian.M;
    std::vector<NamedColumn> columns{{"area", (areas.array() > 0).select(areas, std::nan(""))},
                                     {"h_uniform", uniform_mean_curvature(mesh, topology)},
                                     {"k_gauss", gaussian_curvature(mesh, topology, areas)},
                                     {"h_cotan", cotangent_mean_curvature(mesh, topology, laplacian)},
                                     {"h_uniform_scaled", uniform_mean_curvature_scaled(mesh, topology)}};
    if (with_jets) {
        JetCurvature jet = jet_curvature(mesh, topology);
        columns.push_back({"h_jet", std::move(jet.H)});
        columns.push_back({"k_jet", std::move(jet.K)});
    }
    const bool has_column = kind == OperatorKind::cotan || kind == OperatorKind::uniform;   // h_cotan, h_uniform_scaled
    if (!has_column) columns.push_back(operator_column(prepared, form, kind));
    return columns;
}

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
