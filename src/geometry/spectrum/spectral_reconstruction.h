/// @file
/// A mesh rebuilt from its k smoothest modes: X_k = Φ_k Φ_kᵀ M X. Vertices without mass keep their position.
#pragma once

#include <vector>

#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// X_k and its error for every k, from modes added block by block. Keeps no mode; its memory is some n × 3 matrices.
class ReconstructionStream {
public:
    /// Copies M and X. @throws MeshError if the sizes differ or no vertex has an area
    ReconstructionStream(const Vector& M, const Positions& X);

    /// Adds the next modes, M-orthonormal among themselves and to those before, with their eigenvalues in ascending order.
    void add(const Eigen::Ref<const DenseMatrix>& modes, const Eigen::Ref<const Vector>& eigenvalues);

    int modes() const { return static_cast<int>(energies_.size()); }
    /// Returns X_k, n × 3, for the k modes added so far. [length]
    Positions positions() const;
    /// Returns √(‖X − X_j‖²_M / ΣM) for j = 0 … modes(), by Parseval. [length]
    Vector rms() const;

private:
    Vector M_;
    Positions X_;
    Eigen::RowVector3d centroid_;
    DenseMatrix centred_;            // X about its centroid, n × 3
    DenseMatrix sum_;                // Σ φ_j φ_jᵀ M of centred_
    Vector constant_;                // Σ φ_j φ_jᵀ M 1 over the zero modes
    std::vector<double> energies_;   // |ĉ_j|² [length⁴]
};

/// Returns the k × 3 coefficients Φᵀ M X. [length²]
DenseMatrix spectral_coefficients(const Spectrum& spectrum, const Vector& M, const Positions& X);

/// Returns X_k, n × 3, from the first k modes; vertices without mass keep their position in X. [length]
/// @throws MeshError if there are fewer than k modes or the sizes do not fit
Positions reconstruct(const Spectrum& spectrum, const Vector& M, const Positions& X, int k);

/// Returns √(‖X − X_k‖²_M / ΣM) for k = 0 … number of modes, from the coefficients alone (Parseval). [length]
Vector reconstruction_rms(const Spectrum& spectrum, const Vector& M, const Positions& X);

/// A common mistake, for comparison: uses ψ = M^½φ, the eigenvectors of the symmetric M^−½(−C)M^−½, without mapping them back to
/// φ = M^−½ψ: X_k = Ψ_k Ψ_kᵀ X. The smoothest ψ is √A and not constant, so vertex areas modulate the mesh. Right if all areas are equal.
/// @throws MeshError as reconstruct()
Positions reconstruct_unmapped(const Spectrum& spectrum, const Vector& M, const Positions& X, int k);

/// A common mistake, for comparison: the plain product xᵀφ, as if the M-orthonormal φ were orthonormal: X_k = Φ_k Φ_kᵀ X. Right if all
/// areas are 1. [1/length]
/// @throws MeshError as reconstruct()
Positions reconstruct_unweighted(const Spectrum& spectrum, const Vector& M, const Positions& X, int k);

}   // namespace meshfolio
