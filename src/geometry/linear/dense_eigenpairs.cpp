#include "geometry/linear/dense_eigenpairs.h"

#include <Eigen/Eigenvalues>

#include "base/errors.h"

namespace meshfolio {
namespace {

using Solver = Eigen::SelfAdjointEigenSolver<DenseMatrix>;

DenseEigenpairs pairs_of(const Solver& solver) {
    if (solver.info() != Eigen::Success)
        throw SolverError("the dense eigensolver did not converge",
                          "repair triangles of zero area, which give entries that are not finite");
    return {solver.eigenvalues(), solver.eigenvectors()};
}

}   // namespace

DenseEigenpairs dense_eigenpairs(const DenseMatrix& A) { return pairs_of(Solver(A)); }

}   // namespace meshfolio
