#include "geometry/dense_pairs.h"

#include <Eigen/Eigenvalues>

namespace meshfolio::testing {

DensePairs dense_pairs(const DenseMatrix& A) {
    const Eigen::SelfAdjointEigenSolver<DenseMatrix> solver(A);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

DensePairs dense_pairs(const DenseMatrix& A, const Vector& M) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<DenseMatrix> solver(A, DenseMatrix(M.asDiagonal()));
    return {solver.eigenvalues(), solver.eigenvectors()};
}

DensePairs dense_pairs(const LaplaceBeltrami& laplacian) { return dense_pairs(DenseMatrix(-laplacian.C), laplacian.M); }

}   // namespace meshfolio::testing
