/// @file
/// Positions in rows of four. Private to the layer.
#pragma once

#include <vector>

#include "geometry/linear/aligned_columns.h"

namespace meshfolio {

/// Row i is row vertex[i] of X, and back: the other rows of X stay.
FourColumns gathered(const Positions& X, const std::vector<int>& vertex);
void scatter(const FourColumns& rows, const std::vector<int>& vertex, Positions& X);

}   // namespace meshfolio
