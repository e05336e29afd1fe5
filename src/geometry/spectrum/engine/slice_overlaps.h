/// @file
/// Eigenvectors of different slices are orthogonal to their tolerance only; what is left is measured and removed. Private to the layer.
#pragma once

#include <vector>

#include "geometry/linear/aligned_columns.h"

namespace meshfolio {

inline constexpr int lanes = EightColumns::width;

/// Makes the first k columns of the groups orthonormal, one after the other, E = XᵀX − I being so small that its square does not count.
/// The later one of two gives way: its eigenvalue is the larger, and so is what its residual may be.
/// @return ‖E‖ before, largest entry
double make_orthonormal(std::vector<EightColumns>& X, int k);

}   // namespace meshfolio
