/// @file
/// A mesh rebuilt from its k smoothest modes: X_k = Φ_k Φ_kᵀ M X.
#pragma once

#include <vector>

#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// X_k and its error for every k, from modes that come block by block: none is kept, and nothing larger than n × 3 is made beside them.
class ReconstructionStream {
public:
    /// Copies what it needs. @throws MeshError if the sizes differ or no vertex has an area
    ReconstructionStream(const Vector& M, const Positions& X);

    /// The next modes, M-orthonormal among themselves and to those before, with their eigenvalues in ascending order.
    void add(const Eigen::Ref<const DenseMatrix>& modes, const Eigen::Ref<const Vector>& eigenvalues);

    int modes() const { return static_cast<int>(energies_.size()); }
    /// X_k, k the modes so far. Unreferenced vertices keep their position.
    Positions positions() const;
    /// Entry j: √(‖X − X_j‖²_M / ΣM) for j = 0 … modes(), by Parseval. [length]
    Vector rms() const;

private:
    Vector M_;
    Positions X_;
    Eigen::RowVector3d centroid_;
    DenseMatrix centred_;            // X about its centroid, n × 3
    DenseMatrix sum_;                // Σ φ_j φ_jᵀ M of it
    Vector constant_;                // Σ φ_j φ_jᵀ M 1 over the zero modes
    std::vector<double> energies_;   // |ĉ_j|² [length⁴]
};

/// k × 3 coefficients Φᵀ M X. [length²]
DenseMatrix spectral_coefficients(const Spectrum& spectrum, const Vector& M, const Positions& X);

/// X_k from the first k modes. Unreferenced vertices keep their position.
Positions reconstruct(const Spectrum& spectrum, const Vector& M, const Positions& X, int k);

/// Entry k: √(‖X − X_k‖²_M / ΣM) for k = 0 … number of modes, from the coefficients alone (Parseval). [length]
Vector reconstruction_rms(const Spectrum& spectrum, const Vector& M, const Positions& X);

}   // namespace meshfolio
