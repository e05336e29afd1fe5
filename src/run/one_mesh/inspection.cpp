#include "run/one_mesh/inspection.h"

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "mesh/orientation.h"
#include "mesh/triangle_kind.h"
#include "questions/bench/defects.h"

namespace meshfolio::run {

using nlohmann::ordered_json;

Inspection inspect_mesh(PreparedMesh prepared, OperatorKind kind, const std::function<void(std::string_view)>& progress) {
    Inspection inspection;
    inspection.prepared = std::move(prepared);
    inspection.kind = kind;
    const TriangleMesh& mesh = inspection.prepared.mesh;
    progress("counts and defects");
    inspection.facts = mesh_facts(inspection.prepared);
    try {
        const LaplaceBeltrami laplacian = laplace_operator(mesh, kind);
        inspection.joined_vertices = static_cast<int>(laplacian.copies.size());
        inspection.stability = stability_certificate(laplacian, {.assembly = assembly_of(kind), .progress = progress});
        if (kind == OperatorKind::cotan && inspection.facts.counts.zero_area_faces > 0) {
            const TriangleMesh joined = with_joined_vertices(mesh, laplacian.copies);
            bool has_zero_area = false;   // with distinct vertices
            for (int t = 0; t < joined.face_count() && !has_zero_area; ++t) has_zero_area = kind_of(joined, t) == TriangleKind::zero_area;
            if (has_zero_area) inspection.floored = largest_stable_step(largest_eigenvalue(floored_laplace_beltrami(mesh)));
        }
    } catch (const SolverError& error) {
        inspection.no_stability = error.what();
    } catch (const MeshError& error) {   // no triangle has a stiffness
        if (!(inspection.facts.counts.area > 0)) throw;
        inspection.no_stability = error.what();
    }
    return inspection;
}

namespace {

ordered_json defects_json(const MeshFacts& facts) {
    ordered_json list = ordered_json::array();
    for (const auto& [defect, count] : defects_of(facts)) {
        list.push_back({{"defect", defect->key},
                        {"name", defect->name()},
                        {"count", count},
                        {"affects", affected_questions(*defect)},
                        {"breaks", defect->breaks()},
                        {"done", defect->done()}});
    }
    return list;
}

/// Adds the limits of a stable step. They are null if −C is indefinite, because no step is stable then; the proved ones also if that is
/// undecided.
void add_stability(ordered_json& json, const std::optional<StabilityCertificate>& proved, OperatorKind kind) {
    for (const char* name : {"lambda_crit", "lambda_safe", "lambda_crit_vertex", "lambda_crit_proved", "proved_of", "definiteness"})
        json[name] = nullptr;
    if (!proved) return;
    json["proved_of"] = has_intrinsic_lengths(kind) ? "the operator as stored" : "the mesh";
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

}   // namespace

std::string inspection_json(const Inspection& inspection) {
    const Preflight& p = inspection.prepared.preflight;
    const auto row = [](const Vector3& v) { return ordered_json::array({v.x(), v.y(), v.z()}); };
    ordered_json json{
        {"vertices", p.vertices},
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
        {"watertight", p.closed() && p.manifold() && p.orientable},
        {"nonmanifold_edges", p.nonmanifold_edges},
        {"nonmanifold_vertices", p.nonmanifold_vertices},
        {"zero_area_faces", p.zero_area_faces},
        {"needle_faces", p.needle_faces},
        {"duplicated_positions", p.duplicated_positions},
        {"dropped_degenerate_faces", p.dropped_degenerate_faces},
        {"dropped_duplicate_faces", p.dropped_duplicate_faces},
        {"opposite_faces", p.opposite_faces},
        {"flipped_faces", p.flipped_faces},
        {"inside_out_components", p.inside_out_components},
        {"area", p.area},
        {"encloses_volume", p.encloses_volume()},
        {"volume", p.encloses_volume() ? ordered_json(p.volume) : ordered_json()},
        {"why_no_volume",
         p.encloses_volume() ? ordered_json() : ordered_json(why_no_volume(inspection.prepared.mesh, inspection.prepared.topology))},
        {"mean_edge", p.mean_edge},
        {"box_low", row(p.box_low)},
        {"box_high", row(p.box_high)},
        {"gauss_bonnet",
         {{"deficit_sum_over_2pi", inspection.deficits_over_2pi()},
          {"residual", p.manifold() ? ordered_json(inspection.facts.gauss_bonnet_residual) : ordered_json()}}},
        {"unreferenced_vertices", inspection.facts.unreferenced_vertices},
        {"shortest_edge", inspection.facts.shortest_edge},
        {"longest_edge", inspection.facts.longest_edge},
        {"smallest_angle_deg", inspection.facts.smallest_angle * 180 / std::numbers::pi},
        {"box_diagonal", inspection.facts.diagonal},
        {"offset_in_diagonals", inspection.facts.offset},
        {"coordinate_rounding", inspection.facts.coordinate_rounding},
        {"written_steps", inspection.facts.written_steps},
        {"defects", defects_json(inspection.facts)}};
    add_stability(json, inspection.stability, inspection.kind);
    json["lambda_crit_with_zero_area_faces"] = inspection.floored ? ordered_json(*inspection.floored) : ordered_json();
    json["warnings"] = ordered_json::array();
    for (const MeshWarning& warning : inspection.prepared.warnings)
        json["warnings"].push_back({{"line", warning.line}, {"message", printable(warning.message)}});
    return json.dump(2);
}

}   // namespace meshfolio::run
