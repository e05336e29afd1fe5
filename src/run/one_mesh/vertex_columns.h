/// @file
/// Values per vertex: the columns of `curvature`, and the CSV of such columns.
#pragma once

#include <string>
#include <vector>

#include "geometry/operators/laplace_operator.h"
#include "mesh/io/scalar_type.h"
#include "mesh/mesh_checks.h"

namespace meshfolio::run {

/// area [length²], h_uniform [length], k_gauss [1/length²], h_cotan and h_uniform_scaled [1/length], then, when asked for, h_jet and k_jet,
/// and h_<operator> of any other operator.
std::vector<VertexColumn> curvature_columns(const PreparedMesh& prepared, AreaForm form, OperatorKind kind, bool with_jets);

/// The attributes of the mesh's file together with these columns, which replace columns of the same name.
Attributes beside_attributes(const PreparedMesh& prepared, std::vector<VertexColumn> columns);

/// CSV of `vertex,x,y,z,boundary` and the columns, a row a vertex.
std::string vertex_table(const PreparedMesh& prepared, const std::vector<VertexColumn>& columns);

}   // namespace meshfolio::run
