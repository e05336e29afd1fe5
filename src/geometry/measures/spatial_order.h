/// @file
/// Points along Morton's curve: what is near on it is near in space, so rows worked on together lie together in memory. Private to the
/// layer.
#pragma once

#include <vector>

#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

/// Rows of X in the order of Morton's curve through a cube of 2²¹ cells a side; rows of one cell as they come.
std::vector<int> morton_order(const Positions& X);

/// Rows of the operator in the order in which a product with it is fastest, X being the positions of the whole mesh: Morton's, but among
/// 1024 rows that follow each other those with fewer entries first. Loops over rows of equal length are foreseen by the processor, and
/// 1024 rows fit into its first cache.
std::vector<int> product_order(const OperatorWithMass& whole, const Positions& X);

/// The same operator with row order[i] as row i: of C, of M and of `vertex`, which no longer ascends. Entries of a row ascend in the
/// new order, so that sums over a row are the same whatever the order was before.
OperatorWithMass reordered(const OperatorWithMass& whole, const std::vector<int>& order);

}   // namespace meshfolio
