/// @file
/// Proofs that −C is positive semidefinite. Only then is any explicit step stable: a mode with μ < 0 grows by 1 + λ|μ| in every step.
///
/// The zero eigenvalue of the constants is rounded like all others, so no stored matrix is proved free of eigenvalues below 0, only of such
/// below −ν, where ν is rounding:
///   weights    all C_ij ≥ 0 off the diagonal: ν = max_i (2 Σ_j max(−C_ij, 0) + max(ΣC_i, 0))/M_i by Gershgorin, whatever made C.
///   triangles  C = Σ_t C_t, each C_t that of a flat triangle. The exact C_t is −D_t/|u × v|, D_t ⪰ 0 for any three points, so an error of
///              |u × v| changes no sign. The dot products are off by ε|u||v|: the three weights of t by 3/2 ε s_t, s_t the sum of its
///              cotangents; adding k ≤ t_i of them by t_i ε/2 each. Σ_t s_t around i is at most Σ_j −C_jj over i and its neighbours, so
///              ν = max_i (ε (t_i + 8) Σ_j −C_jj + max(ΣC_i, 0))/M_i, t_i the entries of row i; no triangle may be there twice.
///   factor     rows sum to 0 up to rounding, and −C without one vertex of each component is positive definite: xᵀCx does not change when
///              a constant is added. Cholesky of it less δM runs to its end, δ its own rounding (eigenvalue_enclosure.h).
/// In all three the rounding of the row sums as stored is part of ν. "Semidefinite" means ν ≤ 1e-10 max_i −C_ii/M_i on
/// each component: a million steps at the limit 2/μ_max then raise no mode by more than 2e-4 of itself. "Indefinite" means that a vector
/// proves μ_min < 0.
#pragma once

#include <algorithm>

#include "geometry/spectrum/stability.h"

namespace meshfolio {

/// Prior knowledge of C: `triangles` for a sum of the stiffness matrices of triangles.
enum class Assembly { unknown, triangles };

/// A verdict on −C with its evidence.
struct Definiteness {
    enum class Verdict { semidefinite, indefinite, undecided } verdict = Verdict::undecided;
    double mu_low = 0, mu_high = 0;   // proved: mu_low ≤ μ_min ≤ mu_high; μ_min the smallest eigenvalue of −M⁻¹C [1/length²]
    int factorisations = 0;
    LargestEigenvalue bottom;   // of M⁻¹C: value ≈ −μ_min, its mode and vertex; only if indefinite or undecided

    bool semidefinite() const { return verdict == Verdict::semidefinite; }
    bool indefinite() const { return verdict == Verdict::indefinite; }
    /// Returns a lower bound of the factor by which an explicit step multiplies the lowest mode.
    double growth(double lambda) const { return 1 + lambda * std::max(0.0, -mu_high); }
};

/// Decides whether −C is positive semidefinite, on the vertices with mass. Costs two passes over C if weights or triangles are evidence
/// enough, else factorisations.
/// @throws MeshError as operator_with_mass()
Definiteness definiteness(const LaplaceBeltrami& laplacian, Assembly assembly = Assembly::unknown);

}   // namespace meshfolio
