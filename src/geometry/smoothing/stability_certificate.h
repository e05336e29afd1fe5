/// @file
/// The limit λ_crit = 2/μ_max of explicit smoothing, proved. A step λ is stable if no mode overshoots, λμ_max ≤ 2, and none has μ < 0
/// (definiteness.h). A Cholesky factorisation encloses μ_max from above, a Rayleigh quotient from below (eigenvalue_enclosure.h). The
/// bounds hold for the numbers stored in C and M.
#pragma once

#include <functional>
#include <string_view>

#include "geometry/spectrum/definiteness.h"

namespace meshfolio {

struct StabilityCertificate {
    double mu_low = 0, mu_high = 0;   // proved: mu_low ≤ μ_max ≤ mu_high [1/length²]
    double rounding = 0;              // of the factorisation that proves mu_high, relative; part of the bound
    int factorisations = 0;           // of σM + C: 1 when the first guess held
    int failed = 0;                   // the number of these that broke down: μ_max lay above their σ
    long long factor_nonzeros = 0;    // of the largest factor
    LargestEigenvalue top;            // the best estimate of the top mode
    Definiteness bottom;              // about modes with μ < 0

    /// Returns the largest step proved stable, but for growth of rounding (definiteness.h); 0 unless −C is proved semidefinite. [length²]
    double lambda_low() const { return bottom.semidefinite() ? 2 / mu_high : 0; }
    /// Returns the step above which instability is proved; 0 if −C is indefinite, for then every step is unstable. [length²]
    double lambda_high() const { return bottom.indefinite() ? 0 : 2 / mu_low; }
    /// Returns 2 over the Gershgorin bound: stable and cheap to compute; 0 unless −C is proved semidefinite. [length²]
    double lambda_safe() const { return bottom.semidefinite() ? 2 / top.upper_bound : 0; }
    double relative_width() const { return (mu_high - mu_low) / mu_low; }
    bool refuted() const { return failed > 0; }   // a factorisation just above an estimate broke down
};

struct CertificateOptions {
    double width = 1e-8;                     // wanted (mu_high − mu_low)/mu_low; wider if rounding forbids it (from a million vertices)
    Assembly assembly = Assembly::unknown;   // of C
    std::function<void(std::string_view)> progress = {};   // called with the name of each stage
};

/// Proves bounds of the limit λ_crit. The estimate of plain Lanczos only guides; the last factorisation is the proof. Independent of the
/// number of threads.
/// @throws MeshError as operator_with_mass(), or if no two vertices are joined
StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, const CertificateOptions& options = {});
/// True if Cholesky of σM + C runs to its end, which proves μ_max ≤ σ(1 + ρ), ρ its rounding; false means μ_max > σ up to rounding.
/// @throws MeshError as operator_with_mass()
bool is_positive_definite_at(const LaplaceBeltrami& laplacian, double sigma);

}   // namespace meshfolio
