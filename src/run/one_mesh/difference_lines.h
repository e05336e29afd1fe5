/// @file
/// The table of `compare`.
#pragma once

#include <vector>

#include "geometry/measures/mesh_error.h"

namespace meshfolio::run {

struct DifferenceLine {
    const char* key;   // "rms"; ends with its unit where that is an angle
    double value;      // NaN: not defined
    const char* meaning;
};
std::vector<DifferenceLine> difference_lines(const MeshDifference& difference);

}   // namespace meshfolio::run
