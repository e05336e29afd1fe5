/// @file
/// Values per vertex: fields by name, which are drawn, and the columns of `curvature`.
#pragma once

#include <string>
#include <vector>

#include "geometry/operators/laplace_operator.h"
#include "mesh/io/scalar_type.h"
#include "mesh/mesh_checks.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio::run {

struct Field {
    Vector values;                      // n; empty: none
    std::string quantity, unit;         // for the colour bar
    std::string colormap = "viridis";   // unless the user names one
    double floor = 0;                   // narrowest range of the colours; smaller differences are drawn in one colour
};

std::vector<std::string> operator_choices();   // names of all operators
std::vector<std::string> area_choices();       // barycentric, voronoi, mixed
std::vector<std::string> field_names();        // none, h-uniform, h-cotan and the other operators, gauss, area, x, y, z, id
/// Returns the checks of a mesh that the named field needs: all for h-uniform, which needs the topology, else for_pictures.
Checks checks_for(const std::string& name);
/// Computes the named field of field_names(), NaN where undefined; without values for none and id. @throws UsageError for an unknown name
Field field_of(const PreparedMesh& mesh, const std::string& name);

/// Reads "FILE:COLUMN": a column of a CSV file with a row per vertex, in which empty cells are NaN, or of a mesh file.
/// @throws InputError for a file that does not fit the mesh, UsageError for a missing ":COLUMN"
Field field_from_file(const PreparedMesh& mesh, const std::string& file_and_column);

/// Returns a field of n values, NaN where undefined, without a unit. It is signed if the values are on both sides of 0.
Field field_of_values(Vector values, const std::string& quantity);

// ---- columns -------------------------------------------------------------------------------------------------------------

/// Computes area [length²], h_uniform [length], k_gauss [1/length²], h_cotan and h_uniform_scaled [1/length], with `with_jets` also h_jet
/// and k_jet, and h_<operator> if `kind` is another operator.
std::vector<VertexColumn> curvature_columns(const PreparedMesh& prepared, AreaForm form, OperatorKind kind, bool with_jets);

/// Returns the attributes of the mesh's file with `columns` added; they replace columns with their names.
Attributes attributes_with(const PreparedMesh& prepared, std::vector<VertexColumn> columns);

/// Returns a CSV with a row per vertex: vertex (from 0), x, y, z, boundary (0 or 1) and the columns; NaN cells are empty.
std::string vertex_table(const PreparedMesh& prepared, const std::vector<VertexColumn>& columns);

}   // namespace meshfolio::run
