#pragma once

#include <Eigen/SparseCore>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Column-major; our operators are symmetric or applied by rows through Eigen's products.
using SparseMatrix = Eigen::SparseMatrix<double>;
using DenseMatrix = Eigen::MatrixXd;

}   // namespace meshfolio
