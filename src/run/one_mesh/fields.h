/// @file
/// Per-vertex quantities by name, for `render --field` and the Python module.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_checks.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio::run {

struct Field {
    Vector values;                // n; empty: none
    std::string quantity, unit;   // for the colour bar
    bool is_signed = false;       // drawn with a diverging map
    double floor = 0;             // narrowest range that is worth colours
};

std::vector<std::string> operator_choices();   // the operators' names
std::vector<std::string> field_names();        // none, h-uniform, h-cotan and the other operators, gauss, area, x, y, z, id
/// The checks of a mesh that a field needs.
Checks checks_for(const std::string& name);
/// @throws UsageError for an unknown name
Field field_of(const PreparedMesh& mesh, const std::string& name);

/// A column of a CSV file with one row a vertex, whose empty cells are NaN, or of a mesh's file.
/// @throws InputError for a file that does not fit, UsageError for a missing ":COLUMN"
Field field_from_file(const PreparedMesh& mesh, const std::string& file_and_column);

/// Values of any origin, NaN where undefined: signed if they are on both sides of 0.
Field field_of_values(Vector values, const std::string& quantity);

}   // namespace meshfolio::run
