/// @file
/// Ways of rebuilding a mesh from its modes that look right and are not; here to be shown beside the right one, X_k = Φ_k Φ_kᵀ M X. They
/// agree with it where all vertices have the same area (the last where that area is 1), so a regular mesh does not betray them.
#pragma once

#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// ψ = M^½φ, the eigenvectors of the symmetric M^−½(−C)M^−½, used as they are instead of being mapped back to φ = M^−½ψ:
/// X_k = Ψ_k Ψ_kᵀ X. The smoothest ψ is √A and not constant, so the mesh is modulated by its own vertex areas. [length]
/// @throws MeshError if there are fewer than k modes or the sizes do not fit
Positions reconstruct_unmapped(const Spectrum& spectrum, const Vector& M, const Positions& X, int k);

/// The plain product xᵀφ, as if the M-orthonormal φ were orthonormal: X_k = Φ_k Φ_kᵀ X, without the area even in its unit. [1/length]
/// @throws MeshError as above
Positions reconstruct_unweighted(const Spectrum& spectrum, const Vector& M, const Positions& X, int k);

}   // namespace meshfolio
