/// @file
/// The results of `inspect`: counts, defects, Gauss–Bonnet, the largest stable step and its proof.
#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/measures/mesh_facts.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/smoothing/stability_certificate.h"

namespace meshfolio::run {

struct Inspection {
    PreparedMesh prepared;
    OperatorKind kind = OperatorKind::cotan;   // of the proof
    MeshFacts facts;
    std::optional<StabilityCertificate> stability;   // nothing if it could not be computed
    std::string no_stability;                        // the reason
    /// λ_crit of the operator that gives triangles of zero area a stiffness; nothing if there are no such triangles with distinct vertices
    /// [length²].
    std::optional<double> floored;
    int joined_vertices = 0;   // that the operator identifies with an earlier vertex: ends of edges of length 0

    double deficits_over_2pi() const { return facts.total_deficit / (2 * std::numbers::pi); }
};

/// Returns counts, defects and the proved limit of a stable step of a mesh; if the limit cannot be computed, the reason.
/// @param kind      of the operator for the largest stable step
/// @param progress  called with the name of each step; may throw to stop
/// @throws MeshError for a mesh without any area
Inspection inspect_mesh(PreparedMesh prepared, OperatorKind kind, const std::function<void(std::string_view)>& progress);

/// Returns the JSON of `inspect --json`, with null for undefined values.
std::string inspection_json(const Inspection& inspection);

}   // namespace meshfolio::run
