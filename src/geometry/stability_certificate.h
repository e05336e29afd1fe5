/// @file
/// μ_max between two proved bounds, so that the limit λ_crit = 2/μ_max of explicit smoothing is known and proved.
///   above: Cholesky of σM + C runs to its end ⇒ μ_max ≤ σ(1 + ρ)   (Rump 2006)
///   below: μ_max ≥ yᵀ(−C)y / yᵀMy for every y
///
/// What floating point can prove: the bounds hold for the numbers stored in C and M. The rounding of the factorisation and of the
/// quotient is bounded beforehand and is part of the bounds: the factor computed is exactly that of a matrix no farther from σM + C than
/// ε Σ_j (t_j + 8) s_jj/M_j times M, with s_jj its diagonal (at most σM_j) and t_j the entries in row j of the factor, in whatever order
/// they were summed. Hence ρ = ε(nnz(factor) + 8n). Not covered: the rounding of C and M themselves when they were assembled,
/// underflow, and defects of the processor or of the library that factors.
#pragma once

#include "geometry/stability.h"

namespace meshfolio {

struct StabilityCertificate {
    double mu_low = 0, mu_high = 0;   // proved: mu_low ≤ μ_max ≤ mu_high [1/length²]
    double rounding = 0;              // ρ of the factorisation that proves mu_high, within the bound
    int factorisations = 0;           // 1 when the first guess held
    int failed = 0;                   // of these, how many broke down: μ_max lay above their σ
    long long factor_nonzeros = 0;    // of the largest factor
    LargestEigenvalue top;            // the estimate it began with, or a better one when that was refuted

    double lambda_low() const { return 2 / mu_high; }   // proved stable up to here [length²]
    double lambda_high() const { return 2 / mu_low; }   // proved unstable beyond [length²]
    double relative_width() const { return (mu_high - mu_low) / mu_low; }
    bool refuted() const { return failed > 0; }   // the estimate it began with was below μ_max
};

/// Both bounds, (mu_high − mu_low)/mu_low ≤ `width`. `guess` is what Lanczos returned, whose largest Ritz value can only be too small.
/// Nothing of it is trusted: the quotient of its mode is computed again, and when the factorisation just above it breaks down, μ_max is
/// found by bisection and inverse iteration.
/// @throws MeshError as operator_with_mass, if no two vertices are joined, or if guess.mode has another size;
///         SolverError if rounding keeps the bounds farther apart than `width` (at 1e-8: from about a million vertices)
StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, const LargestEigenvalue& guess, double width = 1e-8);
StabilityCertificate stability_certificate(const LaplaceBeltrami& laplacian, double width = 1e-8);

/// Does Cholesky of σM + C run to its end? True proves μ_max ≤ σ(1 + ρ); false says that μ_max lies above, up to rounding.
/// @throws MeshError as operator_with_mass
bool is_positive_definite_at(const LaplaceBeltrami& laplacian, double sigma);

}   // namespace meshfolio
