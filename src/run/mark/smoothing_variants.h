/// @file
/// Smoothing runs: the right one, and what comes of known mistakes.
#pragma once

#include <vector>

#include "mesh/mesh_checks.h"
#include "run/mark/conventions.h"

namespace meshfolio::run {

/// x, y, z of vertex 0, then of vertex 1, …
inline Vector flat(const Positions& X) { return Eigen::Map<const Vector>(X.data(), X.size()); }

SmoothingOptions smoothing_of(const PreparedMesh& prepared, const AnswerSettings& s);

std::vector<Variant> smoothing_variants(const PreparedMesh& prepared, const AnswerSettings& s);

}   // namespace meshfolio::run
