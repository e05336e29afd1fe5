/// @file
/// The smallest eigenpairs of a mesh of several components. −C is block-diagonal then: each component is solved alone, scaled to an
/// area of its own, and the spectra are merged. Multiplicities that equal components cause, and their differences of scale, so meet
/// no solver. Private to the layer.
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
