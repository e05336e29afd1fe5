#include "geometry/spectrum/spectral_filter.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/spectrum/spectral_reconstruction.h"

namespace meshfolio {

namespace {

/// Width of the passage from one band to the next in ln μ: μ goes with the squared frequency, so this is half an octave of wavelength.
const double passage = std::log(2.0);

/// From 0 to 1 over the passage around `limit`, with a horizontal tangent at both ends.
double step_in_log(double mu, double limit) {
    const double t = std::clamp(std::log(mu / limit) / passage + 0.5, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

void check_gains(const Spectrum& spectrum, const Vector& gains) {
    if (gains.size() == spectrum.eigenvalues.size()) return;
    throw MeshError(std::to_string(gains.size()) + " gains for " + std::to_string(spectrum.eigenvalues.size()) + " modes");
}

}   // namespace

/// X_f = gX + Σ (f_i − g) φ_i ĉ_i: the remainder need not be formed, and with f ≡ g ≡ 1 nothing is rounded.
Positions filtered(const Spectrum& spectrum, const Vector& M, const Positions& X, const Vector& gains, double remainder_gain) {
    check_gains(spectrum, gains);
    const Vector beyond = gains.array() - remainder_gain;
    const DenseMatrix weighted = beyond.asDiagonal() * spectral_coefficients(spectrum, M, X);
    Positions result = remainder_gain * X + spectrum.eigenvectors * weighted;
    for (Eigen::Index v = 0; v < M.size(); ++v) {
        if (!(M[v] > 0)) result.row(v) = X.row(v);
    }
    return result;
}

double filter_displacement(const Spectrum& spectrum, const Vector& M, const Positions& X, const Vector& gains, double remainder_gain) {
    check_gains(spectrum, gains);
    const Vector energies = spectral_coefficients(spectrum, M, X).rowwise().squaredNorm();
    const double left = reconstruction_rms(spectrum, M, X)[gains.size()] * (remainder_gain - 1);
    return std::sqrt((gains.array() - 1).square().matrix().dot(energies) / M.sum() + left * left);
}

double gain_at(const Equaliser& equaliser, double mu) {
    if (equaliser.gains.size() != equaliser.limits.size() + 1) throw MeshError("an equaliser needs one gain more than limits");
    if (!(mu > 0)) return 1;
    double gain = equaliser.gains.front();
    for (std::size_t band = 0; band < equaliser.limits.size(); ++band) {
        gain += (equaliser.gains[band + 1] - equaliser.gains[band]) * step_in_log(mu, equaliser.limits[band]);
    }
    return gain;
}

Vector gains_of(const Equaliser& equaliser, const Vector& eigenvalues) {
    return eigenvalues.unaryExpr([&](double mu) { return gain_at(equaliser, mu); });
}

Vector low_pass_gains(const Vector& eigenvalues, int k) {
    Vector gains = Vector::Zero(eigenvalues.size());
    gains.head(std::clamp<Eigen::Index>(k, 0, gains.size())).setOnes();
    return gains;
}

}   // namespace meshfolio
