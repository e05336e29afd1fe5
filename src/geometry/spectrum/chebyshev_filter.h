/// @file
/// Low-pass without eigenvectors: a polynomial p of −L = M⁻¹(−C), applied by products with C alone. p is a Chebyshev series on [0, b], b a
/// proved bound of the spectrum, so that the rounding of the recurrence is not amplified.
#pragma once

#include <span>
#include <vector>

#include "geometry/operators/cotangent_laplacian.h"

namespace meshfolio {

/// What the polynomial stands for.
enum class LowPass {
    ideal,    // 1 up to the cutoff, 0 beyond; damped by Jackson's factors, which remove Gibbs' overshoot
    smooth,   // exp(−ln 2 (μ/μ_c)²): ½ at the cutoff; its series converges faster than any power
};

struct ChebyshevFilter {
    Vector coefficients;   // c_0 … c_degree: p(μ) = Σ c_j T_j(2μ/b − 1), scaled to p(0) = 1: constants stay
    double bound = 0;      // b [1/length²]

    int degree() const { return static_cast<int>(coefficients.size()) - 1; }
};

/// The response that the polynomial approximates.
double low_pass_response(LowPass kind, double cutoff, double mu);

/// @param cutoff  μ_c > 0 [1/length²]
/// @param bound   at least the largest eigenvalue: gershgorin_bound, or μ_high of a stability certificate [1/length²]
/// @throws MeshError if degree < 1, or not 0 < cutoff, bound < ∞
ChebyshevFilter chebyshev_low_pass(LowPass kind, double cutoff, double bound, int degree);

/// p(μ), 0 ≤ μ ≤ b, by Clenshaw's recurrence.
double response(const ChebyshevFilter& filter, double mu);

/// p(M⁻¹(−C)) X, n × 3: `degree` products with C for the three coordinates together. Unreferenced vertices stay. [length]
/// @throws MeshError if the sizes do not fit
Positions filtered(const ChebyshevFilter& filter, const LaplaceBeltrami& laplacian, const Positions& X);

/// The same for several filters at the cost of the one of largest degree: they share the products.
/// @throws MeshError if the sizes do not fit or the bounds differ
std::vector<Positions> filtered(std::span<const ChebyshevFilter> filters, const LaplaceBeltrami& laplacian, const Positions& X);

/// Additions and multiplications of applying a filter once to the three coordinates.
double operations(const ChebyshevFilter& filter, const LaplaceBeltrami& laplacian);

}   // namespace meshfolio
