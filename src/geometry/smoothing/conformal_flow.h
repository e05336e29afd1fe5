/// @file
/// Conformalised mean curvature flow (Kazhdan, Solomon & Ben-Chen 2012): the stiffness stays that of the input, the masses are those of
/// the current surface. Where the flow is conformal this is mean curvature flow without its singularities.
#pragma once

#include "geometry/denoising/denoising_methods.h"

namespace meshfolio {

/// One step: (M_t − λC₀) X' = M_t X, then recentred and scaled back to the area of the input, component by component. Ends early where
/// nothing is left of the surface.
/// @throws SolverError if a system cannot be factored
DenoisingRun conformalised(const DenoisingInput& input, const DenoisingOptions& options, ImplicitSolver& solver);

}   // namespace meshfolio
