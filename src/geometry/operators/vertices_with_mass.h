/// @file
/// The operator on its degrees of freedom: the vertices that carry mass, coincident ones once. Unreferenced vertices have none; their
/// equations would be 0 = 0. All solvers work on this form.
#pragma once

#include <vector>

#include "geometry/operators/cotangent_laplacian.h"

namespace meshfolio {

/// −C and M on n rows.
struct OperatorWithMass {
    SparseMatrix A;            // n × n: −C among these vertices, rows still summing to 0; positive semidefinite [dimensionless]
    Vector M;                  // n masses, all > 0
    std::vector<int> vertex;   // row i is vertex vertex[i], ascending
    int all_vertices = 0;      // rows of the whole mesh
    std::vector<VertexCopy> copies = {};   // vertices with the values of others

    int size() const { return static_cast<int>(vertex.size()); }
};

/// Returns the operator restricted to the vertices with mass, coincident ones once; weights to other vertices go.
/// @throws MeshError if a mass is negative or not finite, if no vertex has any, or if the sizes of C and M disagree
OperatorWithMass operator_with_mass(const LaplaceBeltrami& laplacian);

/// Returns the rows of the operator spread over the rows of the whole mesh, all_vertices × columns: copies get the row of their first
/// vertex, vertices without mass 0.
DenseMatrix to_all_vertices(const OperatorWithMass& reduced, const DenseMatrix& rows);

/// Connected components: rows joined by nonzero entries of A.
struct Components {
    std::vector<int> label;   // of each row, from 0 in order of first row
    int count = 0;
};
/// Returns the component of each row of A, and their number.
Components components_of(const SparseMatrix& A);

/// Returns B = M^−½ A M^−½ with the pattern of A: symmetric, with the eigenvalues of −L.
SparseMatrix symmetric_form(const SparseMatrix& A, const Vector& M);

/// Returns the index of the first |y_i| of at least 1 − 1e-6 times the largest, so that the result is unique on symmetric meshes.
Eigen::Index first_largest(const Vector& y);

/// Returns diag(weights) · A.
SparseMatrix weighted_by_rows(SparseMatrix A, const Vector& weights);

}   // namespace meshfolio
