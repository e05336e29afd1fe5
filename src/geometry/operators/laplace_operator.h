/// @file
/// Every discrete Laplacian of the program, by name, for --operator and the operator laboratory.
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

/// Lists all operators, in the order of tables.
std::span<const OperatorEntry> operator_list();
/// Returns the entry of an operator in operator_list().
const OperatorEntry& operator_entry(OperatorKind kind);
/// Returns the operator of this name.
/// @throws UsageError with the nearest name and all known ones
OperatorKind operator_named(const std::string& name);

/// True if L = M⁻¹C, and so a smoothing step, has no unit: only for the uniform operator. Other L are in 1/length², their steps are areas.
bool is_dimensionless(OperatorKind kind);

/// Returns `triangles` if the C of the operator is the sum, or a multiple of the sum, of the stiffness matrices of the mesh's own
/// triangles, so that −C is positive semidefinite but for rounding (definiteness.h); else `unknown`, as for intrinsic triangulations, where
/// edges may join a vertex to itself.
Assembly assembly_of(OperatorKind kind);

/// True if C has lengths of edges that flips or a cover have made, rounded once more. On strongly stretched meshes it then belongs to a
/// slightly different surface: proofs hold for the operator as stored.
bool has_intrinsic_lengths(OperatorKind kind);

/// Returns C and M of the operator; M = 0 at unreferenced vertices.
/// @param area  the form of the masses. Two operators ignore it: the uniform one, with valences as masses, and the one normalised per edge,
///              with masses 1 and C = L from barycentric areas. For idt and tufted the areas are those of the intrinsic triangles.
/// @throws SolverError if the flips of an intrinsic Delaunay triangulation do not end
LaplaceBeltrami laplace_operator(const TriangleMesh& mesh, OperatorKind kind, AreaForm area = AreaForm::barycentric);

/// Returns the mean curvature by the operator: ½‖Lx‖ with the sign of −Lx · n, for a dimensionless one times 4/h², h² the mean squared edge
/// of the one-ring. NaN on the boundary, at non-manifold and unreferenced vertices, and for masses ≤ 0. [1/length]
/// @param laplacian  laplace_operator(mesh, kind, …)
Vector operator_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology, OperatorKind kind, const LaplaceBeltrami& laplacian);

}   // namespace meshfolio
