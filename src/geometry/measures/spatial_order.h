/// @file
/// Points along Morton's curve, so that neighbouring rows are near each other in memory. Private to the layer.
#pragma once

#include <vector>

#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

/// Returns the numbers of the rows of X in the order of Morton's curve through a cube of 2²¹ cells a side; rows of one cell in their own
/// order.
std::vector<int> morton_order(const Positions& X);

/// Returns the operator with row order[i] as row i of A, M and `vertex`, which no longer ascends. Entries of a row ascend in the new order,
/// so that sums over a row do not depend on the old one.
OperatorWithMass reordered(const OperatorWithMass& whole, const std::vector<int>& order);

}   // namespace meshfolio
