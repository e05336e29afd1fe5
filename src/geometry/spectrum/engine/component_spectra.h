/// @file
/// The smallest eigenpairs of a mesh of several components, each solved alone, scaled to area 1; then the spectra are merged. So no solver
/// meets the multiplicities of equal components, or differences of scale. Private to the layer.
#pragma once

#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/engine/spectrum_modes.h"

namespace meshfolio {

/// @param A  −C, @param M  its masses, ΣM = 1
/// @param components  of A
/// @param k  at most the rows of A
/// @throws SolverError as for one component, or if the k vectors alone exceed the memory
Modes modes_of_components(const SparseMatrix& A, const Vector& M, const Components& components, int k, const SpectrumOptions& options);

}   // namespace meshfolio
