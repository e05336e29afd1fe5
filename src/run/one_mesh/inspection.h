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
    std::optional<StabilityCertificate> stability;   // nothing when it could not be computed
    std::string no_stability;                        // why
    std::optional<double> floored;                   // λ_crit if triangles without area kept a stiffness; nothing where there are none
                                                     // but those of joined vertices [length²]

    int joined_vertices = 0;   // that are one point with an earlier vertex to the operator: ends of edges without length

    double deficits_over_2pi() const { return facts.total_deficit / (2 * std::numbers::pi); }
};

/// @param kind      whose largest stable step
/// @param progress  called with the name of each step; may throw to stop
/// @throws MeshError for a mesh without any area
Inspection inspect_mesh(PreparedMesh prepared, OperatorKind kind, const std::function<void(std::string_view)>& progress);

/// The object that `inspect --json` prints; what is not defined is null.
std::string inspection_json(const Inspection& inspection);

}   // namespace meshfolio::run
