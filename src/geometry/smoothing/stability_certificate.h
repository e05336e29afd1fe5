/// @file
/// The limit λ_crit = 2/μ_max of explicit smoothing, proved. Two things make a step λ stable: no mode grows by overshooting, λμ_max ≤ 2,
/// and none has μ < 0 (definiteness.h). μ_max is enclosed by a Cholesky factorisation from above and by a Rayleigh quotient from below
/// (eigenvalue_enclosure.h, with what floating point can prove: the bounds hold for the numbers stored in C and M).
#pragma once

#include <functional>
#include <string_view>

#include "geometry/spectrum/definiteness.h"

namespace meshfolio {

struct StabilityCertificate {
    double mu_low = 0, mu_high = 0;   // proved: mu_low ≤ μ_max ≤ mu_high [1/length²]
    double rounding = 0;              // of the factorisation that proves mu_high, over mu_high, and within the bound
    int factorisations = 0;           // of σM + C: 1 when the first guess held
    int failed = 0;                   // of these, how many broke down: μ_max lay above their σ
    long long factor_nonzeros = 0;    // of the largest factor
    LargestEigenvalue top;            // the estimate it began with, or a better one
    Definiteness bottom;              // what is known of the modes below 0

    /// Proved stable up to here, but for the growth of rounding that definiteness.h bounds; 0 unless −C is proved semidefinite. [length²]
    double lambda_low() const { return bottom.semidefinite() ? 2 / mu_high : 0; }
    /// Proved unstable beyond; 0 if −C is indefinite, for then every step is. [length²]
    double lambda_high() const { return bottom.indefinite() ? 0 : 2 / mu_low; }
    /// Twice the inverse of the Gershgorin bound: stable and cheap to know; 0 unless −C is proved semidefinite. [length²]
    double lambda_safe() const { return bottom.semidefinite() ? 2 / top.upper_bound : 0; }
    double relative_width() const { return (mu_high - mu_low) / mu_low; }
    bool refuted() const { return failed > 0; }   // a factorisation just above the first value broke down
};

struct CertificateOptions {
    double width = 1e-8;   // (mu_high − mu_low)/mu_low wanted; wider where rounding forbids it (from a million vertices)
    Assembly assembly = Assembly::unknown;                 // of C
    std::function<void(std::string_view)> progress = {};   // told what begins
};

/// Begins with plain Lanczos; nothing of it is trusted, the last factorisation is the proof. The same with any number of threads.
/// @throws MeshError as operator_with_mass, or if no two vertices are joined
StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, const CertificateOptions& options = {});
/// The same from an estimate of one's own, which may be wrong.
/// @throws MeshError too if guess.mode has another size
StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, const LargestEigenvalue& guess,
                                           const CertificateOptions& options = {});

/// Does Cholesky of σM + C run to its end? True proves μ_max ≤ σ(1 + ρ); false says that μ_max lies above, up to rounding.
/// @throws MeshError as operator_with_mass
bool is_positive_definite_at(const LaplaceBeltrami& laplacian, double sigma);

}   // namespace meshfolio
