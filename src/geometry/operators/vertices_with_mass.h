/// @file
/// The operator on its degrees of freedom: the vertices that carry mass, coincident ones only once. Unreferenced vertices have none; their
/// equations would be 0 = 0. What solves with an operator solves with this.
#pragma once

#include <vector>

#include "geometry/operators/cotangent_laplacian.h"

namespace meshfolio {

struct OperatorWithMass {
    SparseMatrix A;                        // −C among them, rows still summing to 0: positive semidefinite [dimensionless]
    Vector M;                              // their masses, all > 0
    std::vector<int> vertex;               // row i is vertex vertex[i], ascending
    int all_vertices = 0;                  // rows of the whole mesh
    std::vector<VertexCopy> copies = {};   // vertices that have the values of others

    int size() const { return static_cast<int>(vertex.size()); }
};

/// @throws MeshError if a mass is negative or not finite, if no vertex has any, or if the sizes of C and M disagree
OperatorWithMass operator_with_mass(const LaplaceBeltrami& laplacian);

/// Rows of the operator to rows of the whole mesh, copies included; 0 elsewhere.
DenseMatrix to_all_vertices(const OperatorWithMass& reduced, const DenseMatrix& rows);

/// Component label of each row, from 0 in order of first vertex; rows are joined by nonzero entries of A.
struct Components {
    std::vector<int> label;
    int count = 0;
};
Components components_of(const SparseMatrix& A);

/// B = M^−½ A M^−½, of the same pattern: symmetric, with the eigenvalues of −L.
SparseMatrix symmetric_form(const SparseMatrix& A, const Vector& M);

/// Where |y| is largest; of entries equal to rounding, the first, so that a symmetric mesh has one answer.
Eigen::Index first_largest(const Vector& y);

/// diag(weights) · A.
SparseMatrix weighted_by_rows(SparseMatrix A, const Vector& weights);

}   // namespace meshfolio
