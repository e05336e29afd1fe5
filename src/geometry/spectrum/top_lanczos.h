/// @file
/// The largest eigenvalue of a sparse symmetric matrix by plain Lanczos: one recurrence, no restart, no reorthogonalisation.
/// Lost orthogonality brings copies of eigenvalues but never one above the largest (Paige 1980). Private to the layer.
///
/// Spectra's SymEigsSolver, stopped before it converges, takes 0.5 to 0.9 of the time, but hands out no value then; read from its Ritz
/// pairs, the value was 1e83 for an operator of the adaptive flow of question 5's open sheet (StabilitySection.RealMeshes).
#pragma once

#include "geometry/linear/sparse_types.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct TopPair {
    double value = 0;      // yᵀBy: never above the largest eigenvalue, but for rounding
    Vector y;              // unit
    double change = 0;     // by how much the last third of the steps raised the value, relative; 0 where they filled the space
    double residual = 0;   // ‖By − θy‖ by the last entry of T's eigenvector, relative: how good the vector is
};

struct TopLanczos {
    double tolerance = 1e-13;   // of the change at which to stop
    double residual = 1;        // and of the residual
    int most_steps = 250;       // products with the matrix, and as many again for the vector of a large one
};

/// @param start  any vector that is not 0; every eigenvector should have a part in it
TopPair top_by_lanczos(const SparseMatrix& B, const Vector& start, const TopLanczos& options = {});

}   // namespace meshfolio
