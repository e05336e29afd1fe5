/// @file
/// Filters of a mesh in its own frequencies (Vallet & Lévy 2008): each coefficient ĉ_i of the positions is multiplied by a gain f(μ_i),
///   X_f = Σ_{i ≤ K} f(μ_i) φ_i ĉ_i + g (X − X_K),
/// where what the K known modes leave over, the detail beyond K, is carried along with the gain g.
#pragma once

#include <vector>

#include "geometry/spectrum/laplace_spectrum.h"

namespace meshfolio {

/// X_f, n × 3. Linear in the positions and in the gains together; the positions themselves where every gain is 1. Unreferenced vertices
/// stay. [length]
/// @param gains           one for each mode of the spectrum
/// @param remainder_gain  g; 0: only the modes, 1: the detail beyond them stays as it is
/// @throws MeshError if the sizes do not fit
Positions filtered(const Spectrum& spectrum, const Vector& M, const Positions& X, const Vector& gains, double remainder_gain);

/// √(Σ (f_i − 1)² |ĉ_i|² + (g − 1)² ‖X − X_K‖²_M) / √ΣM: how far the filter moves the mesh, area-weighted rms, from the coefficients
/// alone (Parseval). [length]
double filter_displacement(const Spectrum& spectrum, const Vector& M, const Positions& X, const Vector& gains, double remainder_gain);

/// Neighbouring frequency bands. Between two of them the gain passes smoothly over about half an octave of wavelength, which rings less
/// than a jump.
struct Equaliser {
    std::vector<double> limits;   // ascending μ > 0 where one band ends and the next begins [1/length²]
    std::vector<double> gains;    // one more than the limits
};

/// Gain at μ; where two bands meet at an equal distance it is the mean of theirs. The zero modes, which say where the mesh is, belong to no
/// band: 1.
double gain_at(const Equaliser& equaliser, double mu);
/// The gains of a whole spectrum.
Vector gains_of(const Equaliser& equaliser, const Vector& eigenvalues);

/// Gains of the ideal low-pass: 1 for the first k modes, 0 for the others.
Vector low_pass_gains(const Vector& eigenvalues, int k);

}   // namespace meshfolio
