/// @file
/// Every discrete Laplacian the program knows, by name: what --operator accepts and what the operator laboratory compares.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/spectrum/definiteness.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

enum class OperatorKind { cotan, uniform, cotan_no_half, clamped, opposite_mean, edge_normalised, idt, idt_original_mass, tufted };

struct OperatorEntry {
    OperatorKind kind;
    std::string_view name;          // on the command line: "cotan-no-half"
    std::string_view title;         // in tables and pictures
    std::string_view description;   // one sentence
};

std::span<const OperatorEntry> operator_list();
const OperatorEntry& operator_entry(OperatorKind kind);
/// @throws UsageError with the nearest name and all known ones
OperatorKind operator_named(const std::string& name);
/// "cotan, uniform, …" for help and messages.
std::string operator_names();

/// Does L = M⁻¹C have no unit, so that a smoothing step has none either? True for the uniform operator and for no other,
/// whose L is in 1/length² and whose steps are areas.
bool is_dimensionless(OperatorKind kind);

/// Is C the sum of the stiffness matrices of the mesh's own triangles, so that −C is positive semidefinite but for rounding
/// (definiteness.h)? That is not said of intrinsic triangulations, whose edges may join a vertex to itself.
Assembly assembly_of(OperatorKind kind);

/// Are lengths of C those of edges that flips or a cover have made, rounded once more? On strongly stretched meshes C then is that of a
/// slightly different surface: what is proved of it is proved of the operator as stored.
bool has_intrinsic_lengths(OperatorKind kind);

/// C and M of the operator, M = 0 at unreferenced vertices.
/// @param area  how the masses are measured. The uniform operator has the valences as masses, the one normalised per edge has
///              ones (its C is L itself, made with barycentric areas); both leave `area` aside. For idt and tufted they are those
///              of the intrinsic triangles.
/// @throws SolverError if the flips of an intrinsic Delaunay triangulation do not end
LaplaceBeltrami laplace_operator(const TriangleMesh& mesh, OperatorKind kind, AreaForm area = AreaForm::barycentric);

/// Mean curvature by the operator: ½‖Lx‖ with the sign of −Lx · n; that of a dimensionless one is scaled by 4/h², h² the mean squared edge
/// of the one-ring. NaN where cotangent_mean_curvature has it. [1/length]
/// @param laplacian  laplace_operator(mesh, kind, …)
Vector operator_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology, OperatorKind kind, const LaplaceBeltrami& laplacian);

}   // namespace meshfolio
