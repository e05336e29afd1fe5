/// @file
/// Values per vertex: the columns of `curvature`, and tables of columns.
#pragma once

#include <string>
#include <vector>

#include "geometry/operators/laplace_operator.h"
#include "mesh/io/scalar_type.h"
#include "mesh/mesh_checks.h"

namespace meshfolio::run {

/// Computes area [length²], h_uniform [length], k_gauss [1/length²], h_cotan and h_uniform_scaled [1/length], with `with_jets` also h_jet
/// and k_jet, and h_<operator> if `kind` is another operator.
std::vector<VertexColumn> curvature_columns(const PreparedMesh& prepared, AreaForm form, OperatorKind kind, bool with_jets);

/// Adds columns to the attributes of the mesh's file; they replace columns of the same name.
Attributes beside_attributes(const PreparedMesh& prepared, std::vector<VertexColumn> columns);

/// Returns a CSV with a row per vertex: vertex, x, y, z, boundary and the columns.
std::string vertex_table(const PreparedMesh& prepared, const std::vector<VertexColumn>& columns);

}   // namespace meshfolio::run
