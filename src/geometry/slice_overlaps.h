/// @file
/// Eigenvectors of different slices are orthogonal to their tolerance only; what is left is measured and removed. Private to the layer.
#pragma once

#include <vector>

#include "geometry/eight_columns.h"

namespace meshfolio {

/// Makes the first k columns of the groups orthonormal: X (I − E/2), E = XᵀX − I, which for a small E is the nearest such basis.
/// @return ‖E‖ before, largest entry
double make_orthonormal(std::vector<EightColumns>& X, int k);

}   // namespace meshfolio
