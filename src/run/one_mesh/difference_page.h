/// @file
/// The page of `compare --html`: numbers, pictures and distances of two meshes in one file.
#pragma once

#include <string>

#include "run/one_mesh/difference_lines.h"

namespace meshfolio::run {

std::string difference_page(const PreparedMesh& a, const PreparedMesh& b, const Difference& difference, const SurfaceDistances& distances);

}   // namespace meshfolio::run
