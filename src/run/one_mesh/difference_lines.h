/// @file
/// The table of `compare`.
#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio::run {

struct DifferenceLine {
    const char* key;   // "rms"; ends with its unit where that is an angle
    double value;      // NaN: not defined
    const char* meaning;
};
/// b measured against a. The last line is a count, that of inverted faces. @throws MeshError if the triangles differ
std::vector<DifferenceLine> difference_lines(const TriangleMesh& a, const TriangleMesh& b);

}   // namespace meshfolio::run
