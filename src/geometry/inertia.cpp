#include "geometry/inertia.h"

#include "geometry/sparse_factor.h"

namespace meshfolio {

int inertia_below(const SparseMatrix& A, const Vector& M, double sigma) {
    SparseMatrix diagonal(A.rows(), A.cols());
    diagonal = (-sigma * M).asDiagonal();
    return SparseFactor::ldlt(A + diagonal).negative_pivots();
}

}   // namespace meshfolio
