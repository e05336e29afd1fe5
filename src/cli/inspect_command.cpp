#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "base/number_text.h"
#include "cli/commands.h"
#include "cli/fields.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/smoothing/stability_certificate.h"
#include "questions/preflight/defects.h"
#include "run/console.h"
#include "run/progress.h"

namespace meshfolio::cli {

namespace {

using nlohmann::ordered_json;

struct Inspection {
    PreparedMesh prepared;
    MeshFacts facts;
    std::optional<StabilityCertificate> stability;   // nothing when it could not be computed
    std::optional<double> floored;   // λ_crit if triangles without area kept a stiffness; nothing where there are none [length²]

    double deficits_over_2pi() const { return facts.total_deficit / (2 * std::numbers::pi); }
};

Inspection inspection_of(const std::string& file, OperatorKind kind) {
    Inspection inspection;
    inspection.prepared = load_mesh(file);
    const TriangleMesh& mesh = inspection.prepared.mesh;
    std::optional<Stage> stage;
    const auto progress = [&](std::string_view what) { stage.emplace(std::string(what)); };
    progress("counts and defects");
    inspection.facts = mesh_facts(inspection.prepared);
    try {
        inspection.stability = stability_certificate(laplace_operator(mesh, kind), {.assembly = assembly_of(kind), .progress = progress});
        if (kind == OperatorKind::cotan && inspection.facts.counts.zero_area_faces > 0)
            inspection.floored = largest_stable_step(largest_eigenvalue(floored_laplace_beltrami(mesh)));
    } catch (const SolverError& error) {
        warn(file + ": largest stable step not computed: " + error.what());
    } catch (const MeshError& error) {   // no triangle has a stiffness; without any area the mesh is refused
        if (!(inspection.facts.counts.area > 0)) throw;
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

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// What was found, which questions it affects and what was done.
std::string consequences(const MeshFacts& facts) {
    std::string text;
    for (const auto& [defect, count] : preflight::defects_of(facts)) {
        text += "  " + std::to_string(count) + " x " + defect->name() + "\n    affects " + preflight::affected_for_people(*defect) + ": " +
                defect->breaks() + "\n    done: " + defect->done() + "\n";
    }
    return text.empty() ? "nothing found that affects a question\n" : "found\n" + text;
}

std::string line(const std::string& name, const std::string& value) { return name + std::string(26 - name.size(), ' ') + value + "\n"; }

std::string in_words(const StabilityCertificate& proved) {
    const Definiteness& d = proved.bottom;
    const double limit = largest_stable_step(proved.top);
    const std::string interval =
        "smallest eigenvalue between " + plain_text(rounded_down(d.mu_low, 4), 4) + " and " + plain_text(rounded_up(d.mu_high, 4), 4);
    const std::string edge = "unstable from " + plain_text(rounded_up(2 / proved.mu_low, 10), 10);
    if (d.indefinite()) {
        return line("largest stable lambda",
                    "none: the operator is indefinite, " + interval + ", at vertex " + std::to_string(d.bottom.vertex)) +
               line("proved", "a step multiplies that mode by 1 + " + plain_text(rounded_down(-d.mu_high, 4), 4) + " lambda or more: by " +
                                  plain_text(rounded_down(d.growth(limit), 6), 6) + " at " + plain_text(limit, 4) + " (2/mu_max)");
    }
    if (!d.semidefinite()) {
        return line("largest stable lambda", "at most " + plain_text(limit, 8) + ", set at vertex " + std::to_string(proved.top.vertex)) +
               line("proved", edge + "; no step is proved stable: " + interval + ", which cannot be in_words from 0 here");
    }
    return line("largest stable lambda", plain_text(limit, 8) + " (always safe: " + plain_text(rounded_down(proved.lambda_safe(), 4), 4) +
                                             "), set at vertex " + std::to_string(proved.top.vertex)) +
           line("proved", "stable up to " + plain_text(rounded_down(proved.lambda_low(), 10), 10) + ", " + edge);
}

std::string in_words(const Inspection& inspection) {
    const Preflight& p = inspection.prepared.preflight;
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
    text += line("edge lengths", plain_text(inspection.facts.shortest_edge) + " to " + plain_text(inspection.facts.longest_edge));
    text += line("smallest angle", plain_text(degrees(inspection.facts.smallest_angle), 4) + " degrees");
    const Vector3 extent = p.box_high - p.box_low;
    text += line("box", plain_text(extent.x()) + " x " + plain_text(extent.y()) + " x " + plain_text(extent.z()) + ", " +
                            plain_text(inspection.facts.offset, 3) + " diagonals from the origin (centred and scaled inside)");
    text +=
        line("Gauss-Bonnet", "sum of deficits / 2 pi = " + plain_text(inspection.deficits_over_2pi(), 12) +
                                 (p.manifold() ? ", off by " + plain_text(inspection.facts.gauss_bonnet_residual, 2) : ", not manifold"));
    if (inspection.stability) text += in_words(*inspection.stability);
    if (inspection.floored) {
        text += line("with zero-area faces", plain_text(*inspection.floored, 8) +
                                                 " if their cotangents counted, cut off at 1e12; flip edges, or take --operator idt");
    }
    return text + consequences(inspection.facts);
}

ordered_json consequences_json(const MeshFacts& facts) {
    ordered_json list = ordered_json::array();
    for (const auto& [defect, count] : preflight::defects_of(facts)) {
        list.push_back({{"defect", defect->key},
                        {"name", defect->name()},
                        {"count", count},
                        {"affects", preflight::affected_questions(*defect)},
                        {"breaks", defect->breaks()},
                        {"done", defect->done()}});
    }
    return list;
}

/// Where −C is indefinite no step is stable: the limits are null. Where that is undecided, none is proved.
void add_stability(ordered_json& json, const std::optional<StabilityCertificate>& proved) {
    for (const char* name : {"lambda_crit", "lambda_safe", "lambda_crit_vertex", "lambda_crit_proved", "definiteness"})
        json[name] = nullptr;
    if (!proved) return;
    const Definiteness& d = proved->bottom;
    const double limit = largest_stable_step(proved->top);
    json["definiteness"] = {{"verdict", d.semidefinite() ? "semidefinite"
                                        : d.indefinite() ? "indefinite"
                                                         : "undecided"},
                            {"mu_min", ordered_json::array({d.mu_low, d.mu_high})},
                            {"mu_max", ordered_json::array({proved->mu_low, proved->mu_high})},
                            {"vertex", d.indefinite() ? ordered_json(d.bottom.vertex) : ordered_json()},
                            {"growth_per_step", d.indefinite() ? ordered_json(d.growth(limit)) : ordered_json()}};
    if (d.indefinite()) return;
    json["lambda_crit"] = limit;
    json["lambda_crit_vertex"] = proved->top.vertex;
    if (!d.semidefinite()) return;
    json["lambda_safe"] = proved->lambda_safe();
    json["lambda_crit_proved"] = ordered_json::array({proved->lambda_low(), proved->lambda_high()});
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
                       {{"deficit_sum_over_2pi", inspection.deficits_over_2pi()},
                        {"residual", p.manifold() ? ordered_json(inspection.facts.gauss_bonnet_residual) : ordered_json()}}},
                      {"unreferenced_vertices", inspection.facts.unreferenced_vertices},
                      {"shortest_edge", inspection.facts.shortest_edge},
                      {"longest_edge", inspection.facts.longest_edge},
                      {"smallest_angle_deg", degrees(inspection.facts.smallest_angle)},
                      {"box_diagonal", inspection.facts.diagonal},
                      {"offset_in_diagonals", inspection.facts.offset},
                      {"coordinate_rounding", inspection.facts.coordinate_rounding},
                      {"defects", consequences_json(inspection.facts)}};
    add_stability(json, inspection.stability);
    json["lambda_crit_with_zero_area_faces"] = inspection.floored ? ordered_json(*inspection.floored) : ordered_json();
    json["warnings"] = ordered_json::array();
    for (const MeshWarning& warning : inspection.prepared.warnings)
        json["warnings"].push_back({{"line", warning.line}, {"message", printable(warning.message)}});
    return json;
}

}   // namespace

Command inspect_command(CLI::App& parent) {
    struct Options {
        std::string mesh, laplacian = "cotan";
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CommandOptions app(parent, "inspect", "Preflight of a mesh: counts, defects, Gauss-Bonnet, largest stable step");
    app.required("MESH", options->mesh, "OBJ, OFF, PLY or STL");
    app.choice("--operator", options->laplacian, operator_choices(), "whose largest stable step");
    app.flag("--json", options->json, "for programs");
    app.footer("Example: meshfolio inspect bunny.off --json");
    return {app, [options] {
                const OperatorKind kind = operator_named(options->laplacian);
                const Inspection inspection = about_mesh(options->mesh, [&] { return inspection_of(options->mesh, kind); });
                print(options->json ? as_json(inspection).dump(2) + "\n" : in_words(inspection));
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
