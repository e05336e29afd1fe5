/// @file
/// n × 4 numbers by rows: three coordinates and a zero, so that a step reads each weight once for all coordinates. Private to the layer.
#pragma once

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

using FourColumns = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

using Four = Eigen::Array4d;   // a row
inline Eigen::Map<Four> row_of(FourColumns& X, Eigen::Index i) { return Eigen::Map<Four>(X.data() + 4 * i); }
inline Eigen::Map<const Four> row_of(const FourColumns& X, Eigen::Index i) { return Eigen::Map<const Four>(X.data() + 4 * i); }

}   // namespace meshfolio
