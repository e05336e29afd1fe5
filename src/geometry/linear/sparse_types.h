#pragma once

#include <Eigen/SparseCore>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Column-major; operators are symmetric, or applied by Eigen's products.
using SparseMatrix = Eigen::SparseMatrix<double>;
using DenseMatrix = Eigen::MatrixXd;

}   // namespace meshfolio
