/// @file
/// Points along Morton's curve, so that rows worked on together lie together in memory. Private to the layer.
#pragma once

#include <vector>

#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

/// Rows of X in the order of Morton's curve through a cube of 2²¹ cells a side; rows of one cell as they come.
std::vector<int> morton_order(const Positions& X);

/// The same operator with row order[i] as row i: of C, of M and of `vertex`, which no longer ascends. Entries of a row ascend in the
/// new order, so that sums over a row are the same whatever the order was before.
OperatorWithMass reordered(const OperatorWithMass& whole, const std::vector<int>& order);

}   // namespace meshfolio
