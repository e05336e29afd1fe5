/// @file
/// Whether eigenpairs are right and none is missing: proved, refuted, or not to be proved here. All is measured on the operator and the
/// mesh alone; of what the solver says about its own work, only a hint where to count is used.
///
/// What is proved. A = −C by its lower triangle and M are taken as stored, every double an exact number; μ_1 ≤ μ_2 ≤ … are the exact
/// eigenvalues of Aφ = μMφ. Of the pairs (θ_j, φ_j) found, θ ascending, f have θ_j < σ.
///  - At least f eigenvalues are ≤ u. By Courant–Fischer μ_f is at most the largest Ritz value on span φ_1 … φ_f. With residuals
///    R = AΦ − MΦΘ, ρ = (Σ_j ‖r_j‖²_{M⁻¹})^½ and η = ‖ΦᵀMΦ − I‖_F, that value is at most u = (θ_f + η max|θ_j| + (1 + η) ρ)/(1 − η).
///    η and ρ hold the rounding of computing them.
///  - At most c eigenvalues are < σ − δ, and at least c are < σ + δ: c is the inertia of an LDLᵀ with rounding bound δ (inertia.h).
///  - So c = f and u < σ − δ leave exactly f eigenvalues below σ − δ, and those found are they: none is missing. By Kahan's theorem for
///    f orthonormal vectors each found value is within ρ, to first order, of its own eigenvalue. No gap is taken from elsewhere.
///  - If no value found, its residual included, lies within δ of σ, then c ≠ f refutes that exactly those found lie below σ.
/// σ lies in the middle of the gap behind the last value found. Where more lie below that σ, k may cut a cluster, or the last gap hides
/// another eigenvalue: then σ is put just below the last cluster of those found, at most 0.1 % below it. Proved then is what lies below
/// σ; the members found of that last cluster lie between σ − δ and their own upper bound.
/// Not covered: whether the stored A and M are those of the mesh (the operator checks see to that), and triangles that cotangents had to
/// be floored or left out for. The vectors inside a cluster are only shown to be orthonormal with small residuals.
#pragma once

#include "geometry/linear/inertia.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct SpectrumCertificate {
    /// ‖−Cφ − μMφ‖_{M⁻¹}/(μ‖φ‖_M) of the pair that is nearest to its limit, or farthest beyond it; infinite where a number is not finite.
    /// An eigenvalue lies within it, relatively, in this norm and no other. The limit is 1e-8, or what rounding of the operator's largest
    /// rows leaves, 100 ε max(A_ii/M_ii)/μ, but never above 1e-6: beyond that a pair may be another one. For what counts as zero, μ₀ stands
    /// for μ: μ₀ = median A_ii / ΣM is the operator's own unit: some 4 over the area for cotangents, whatever the unit of length. Where a
    /// pair lives on smaller components, their own units, weighted by its share on each.
    double residual = 0, residual_limit = 1e-8;
    double residual_rounding = 0;      // what rounding may leave of it: beyond the limit, but not beyond this, nothing is decided
    double orthonormality_error = 0;   // largest entry of |ΦᵀMΦ − I|
    double parseval_gap = 0;   // |‖x‖²_M − Σ|ĉ|² − ‖x − Φĉ‖²_M| / ‖x‖²_M for the positions x about their centroid
    int pairs = 0;             // k
    /// That exactly the pairs found below σ are the eigenvalues there.
    Proof complete = Proof::undecided;
    /// σ behind the last eigenvalue or, where k cuts a cluster, just below that cluster; eigenvalues of the operator below it, by inertia,
    /// −1 where no factorisation is usable; eigenvalues of the spectrum below it. [1/length²]
    double shift = 0;
    int counted_below = -1, found_below = 0;
    double delta = 0,
           gap = 0;   // rounding of the count; distance of σ from u and from the next value found: proved needs δ < gap [1/length²]
    bool delta_is_measured = false;   // by probing, because other processes hold the factor: `complete` rests on it
    int zero_eigenvalues = 0;         // μ ≤ 1e-9 of their own μ₀, and where these are too many, not out of rounding
    int components = 0;               // of the mesh, by its triangles; those without area may or may not join two
    bool zeros_undecided = false;     // these differ, but rounding hides which of the pairs in question have eigenvalue 0
    int expected_zeros = 0;           // as many, at most k
    double smallest_step_up = 0;      // of the eigenvalues from one to the next, over the largest: negative where they are not ascending

    static constexpr double orthonormality_limit = 1e-9, parseval_limit = 1e-9, step_down_limit = 1e-12;

    /// Nothing was found below σ and nothing counted: k cuts the first cluster, as where k is less than the components.
    bool says_nothing() const { return found_below == 0 && counted_below == 0; }
    bool residual_undecided() const { return residual > residual_limit && residual <= residual_rounding; }
    /// refuted where anything measured is beyond its limit or the count is; proved where all is well and none is missing.
    Proof verdict() const;
    bool holds() const { return verdict() == Proof::proved; }
};

/// Costs one sparse factorisation, seldom more, and products with Φ; no eigenvalue is computed.
/// @param spectrum    any pairs, also wrong ones
/// @param inertia_at  another way to count
/// @throws MeshError if the sizes do not fit together, or nothing is in the spectrum
SpectrumCertificate certify_spectrum(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const Spectrum& spectrum,
                                     const InertiaAt& inertia_at = meshfolio::inertia_at);

/// Eigenvalues of −Cφ = μMφ below σ, with the rounding of the count. [1/length²]
/// @throws SolverError if σ is so near an eigenvalue of a leading part that a pivot is lost in rounding
Inertia eigenvalues_below(const LaplaceBeltrami& laplacian, double sigma);

/// Whether exactly those of `values` (ascending) that are below σ are the eigenvalues there, by the count alone.
/// undecided where one of them lies within δ of σ.
Proof agreement(const Inertia& inertia, const Vector& values);

}   // namespace meshfolio
