#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "cli/commands.h"
#include "cli/console.h"
#include "geometry/curvature.h"
#include "geometry/stability.h"
#include "number_text.h"

namespace meshfolio::cli {

namespace {

using nlohmann::ordered_json;

struct Inspection {
    PreparedMesh prepared;
    double total_deficit = 0;               // Σ angle deficit [rad]
    int floored = 0;                        // triangles whose cotangents were floored
    std::optional<LargestEigenvalue> top;   // of −L; nothing when it could not be computed

    double gauss_bonnet_residual() const {
        return std::abs(total_deficit / (2 * std::numbers::pi) - prepared.preflight.euler_characteristic);
    }
};

Inspection inspection_of(const std::string& file) {
    Inspection inspection;
    inspection.prepared = load_mesh(file);
    const TriangleMesh& mesh = inspection.prepared.mesh;
    inspection.total_deficit = angle_deficit(mesh, inspection.prepared.topology).sum();
    corner_cotangents(mesh, &inspection.floored);
    try {
        inspection.top = largest_eigenvalue(laplace_beltrami(mesh));
    } catch (const SolverError& error) {
        warn(file + ": largest stable step not computed: " + error.what());
    }
    return inspection;
}

/// The line that scripts read.
std::string facts_line(const Preflight& p) {
    return "V=" + std::to_string(p.vertices_in_use) + " F=" + std::to_string(p.triangles) +
           " chi=" + std::to_string(p.euler_characteristic) + " comps=" + std::to_string(p.components) +
           " bedges=" + std::to_string(p.boundary_edges) + " area=" + plain_text(p.area, 10) + "\n";
}

std::string told(const Inspection& inspection) {
    const Preflight& p = inspection.prepared.preflight;
    const auto line = [](const std::string& name, const std::string& value) {
        return name + std::string(26 - name.size(), ' ') + value + "\n";
    };
    const auto count = [&](const std::string& name, int n) { return line(name, std::to_string(n)); };
    std::string text = facts_line(p);
    text += count("unreferenced vertices", p.vertices - p.vertices_in_use);
    text += count("edges", p.edges) + count("boundary loops", p.boundary_loops);
    text += line("genus", p.genus >= 0 ? std::to_string(p.genus) : "not defined");
    text += line("orientable", p.orientable ? "yes" : "no");
    text += count("non-manifold edges", p.nonmanifold_edges) + count("non-manifold vertices", p.nonmanifold_vertices);
    text += count("zero-area faces", p.zero_area_faces) + count("needle faces", p.needle_faces) +
            count("duplicated positions", p.duplicated_positions);
    text += count("dropped faces", p.dropped_degenerate_faces + p.dropped_duplicate_faces);
    text += count("flipped faces", p.flipped_faces) + count("inside-out components", p.inside_out_components);
    if (p.closed()) text += line("volume", plain_text(p.volume));
    text += line("mean edge", plain_text(p.mean_edge));
    const Vector3 extent = p.box_high - p.box_low;
    text += line("box", plain_text(extent.x()) + " x " + plain_text(extent.y()) + " x " + plain_text(extent.z()));
    text += line("Gauss-Bonnet", "sum of deficits / 2 pi = " + plain_text(inspection.total_deficit / (2 * std::numbers::pi), 12) +
                                     (p.manifold() ? ", off by " + plain_text(inspection.gauss_bonnet_residual(), 2) : ", not manifold"));
    if (inspection.top) {
        text += line("largest stable lambda", plain_text(largest_stable_step(*inspection.top), 8) +
                                                  " (always safe: " + plain_text(2 / inspection.top->upper_bound, 4) + "), set at vertex " +
                                                  std::to_string(inspection.top->vertex));
    }
    return text;
}

ordered_json as_json(const Inspection& inspection) {
    const Preflight& p = inspection.prepared.preflight;
    const auto row = [](const Vector3& v) { return ordered_json::array({v.x(), v.y(), v.z()}); };
    ordered_json json{{"vertices", p.vertices},
                      {"vertices_in_use", p.vertices_in_use},
                      {"triangles", p.triangles},
                      {"edges", p.edges},
                      {"components", p.components},
                      {"boundary_edges", p.boundary_edges},
                      {"boundary_loops", p.boundary_loops},
                      {"euler_characteristic", p.euler_characteristic},
                      {"genus", p.genus >= 0 ? ordered_json(p.genus) : ordered_json()},
                      {"orientable", p.orientable},
                      {"closed", p.closed()},
                      {"manifold", p.manifold()},
                      {"nonmanifold_edges", p.nonmanifold_edges},
                      {"nonmanifold_vertices", p.nonmanifold_vertices},
                      {"zero_area_faces", p.zero_area_faces},
                      {"needle_faces", p.needle_faces},
                      {"floored_cotangents", inspection.floored},
                      {"duplicated_positions", p.duplicated_positions},
                      {"dropped_degenerate_faces", p.dropped_degenerate_faces},
                      {"dropped_duplicate_faces", p.dropped_duplicate_faces},
                      {"flipped_faces", p.flipped_faces},
                      {"inside_out_components", p.inside_out_components},
                      {"area", p.area},
                      {"volume", p.closed() ? ordered_json(p.volume) : ordered_json()},
                      {"mean_edge", p.mean_edge},
                      {"box_low", row(p.box_low)},
                      {"box_high", row(p.box_high)},
                      {"gauss_bonnet",
                       {{"deficit_sum_over_2pi", inspection.total_deficit / (2 * std::numbers::pi)},
                        {"residual", p.manifold() ? ordered_json(inspection.gauss_bonnet_residual()) : ordered_json()}}}};
    if (inspection.top) {
        json["lambda_crit"] = largest_stable_step(*inspection.top);
        json["lambda_safe"] = 2 / inspection.top->upper_bound;
        json["lambda_crit_vertex"] = inspection.top->vertex;
    } else {
        json["lambda_crit"] = json["lambda_safe"] = json["lambda_crit_vertex"] = nullptr;
    }
    json["warnings"] = ordered_json::array();
    for (const MeshWarning& warning : inspection.prepared.warnings)
        json["warnings"].push_back({{"line", warning.line}, {"message", printable(warning.message)}});
    return json;
}

}   // namespace

Command inspect_command(CLI::App& parent) {
    struct Options {
        std::string mesh;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* app = parent.add_subcommand("inspect", "Preflight of a mesh: counts, defects, Gauss-Bonnet, largest stable step");
    app->add_option("MESH", options->mesh, "OBJ, OFF, PLY or STL")->required();
    app->add_flag("--json", options->json, "for programs");
    app->footer("Example: meshfolio inspect bunny.off --json");
    return {app, [options] {
                const Inspection inspection = inspection_of(options->mesh);
                print(options->json ? as_json(inspection).dump(2) + "\n" : told(inspection));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
