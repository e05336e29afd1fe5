/// @file
/// A certificate of eigenpairs: that they are right and none is missing is proved, refuted, or undecided. All is measured on the operator
/// and the mesh; the solver contributes only a hint where to count.
///
/// The proof. A = −C by its lower triangle and M are taken as stored, every double an exact number; μ_1 ≤ μ_2 ≤ … are the exact
/// eigenvalues of Aφ = μMφ. Of the pairs (θ_j, φ_j) found, θ ascending, f have θ_j < σ.
///  - At least f eigenvalues are ≤ u. By Courant–Fischer μ_f is at most the largest Ritz value on span φ_1 … φ_f. With residuals
///    R = AΦ − MΦΘ, ρ = (Σ_j ‖r_j‖²_{M⁻¹})^½ and η = ‖ΦᵀMΦ − I‖_F, that value is at most u = (θ_f + η max|θ_j| + (1 + η) ρ)/(1 − η).
///    η and ρ hold the rounding of computing them.
///  - At most c eigenvalues are < σ − δ, and at least c are < σ + δ: c is the inertia of an LDLᵀ with rounding bound δ (inertia.h).
///  - So c = f and u < σ − δ leave exactly f eigenvalues below σ − δ, and those found are they: none is missing. By Kahan's theorem for
///    f orthonormal vectors each found value is within ρ, to first order, of its own eigenvalue. No gap is taken from elsewhere.
///  - If no value found, its residual included, lies within δ of σ, then c ≠ f refutes that exactly those found lie below σ.
/// σ lies in the middle of the gap above the last value found. If more lie below that σ, k may cut a cluster, or the last gap hides another
/// eigenvalue: then σ is put just below the last cluster of those found, at most 0.1 % below it. The proof then covers eigenvalues below σ;
/// the members found of that last cluster lie between σ − δ and their own upper bound.
/// Not covered: whether the stored A and M are those of the mesh (the operator checks test that), and triangles without area, with floored
/// or missing cotangents. The vectors inside a cluster are only shown to be orthonormal with small residuals.
#pragma once

#include "geometry/linear/inertia.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct SpectrumCertificate {
    /// ‖−Cφ − μMφ‖_{M⁻¹}/(μ‖φ‖_M) of the pair nearest to its limit, or farthest beyond it; infinite if a number is not finite. An
    /// eigenvalue lies within it, relatively, in this norm only. The limit is 1e-8, or the rounding of the operator's largest rows, 100 ε
    /// max(A_ii/M_ii)/μ, but at most 1e-6: beyond that a pair may be another one. For zero eigenvalues μ₀ stands for μ: μ₀ = median A_ii /
    /// ΣM is the unit of the operator, some 4 over the area for cotangents. For a pair on smaller components it is the mean of their μ₀,
    /// weighted by its share on each.
    double residual = 0, residual_limit = 1e-8;
    double residual_rounding = 0;      // undecided between the limit and this rounding
    double orthonormality_error = 0;   // largest entry of |ΦᵀMΦ − I|
    double parseval_gap = 0;   // |‖x‖²_M − Σ|ĉ|² − ‖x − Φĉ‖²_M| / ‖x‖²_M for the positions x about their centroid
    int pairs = 0;             // k
    /// Whether exactly the pairs found below σ are the eigenvalues there.
    Proof complete = Proof::undecided;
    /// σ above the last eigenvalue or, if k cuts a cluster, just below that cluster; the operator's eigenvalues below σ by inertia, −1 if
    /// no factorisation is usable; the spectrum's eigenvalues below σ. [1/length²]
    double shift = 0;
    int counted_below = -1, found_below = 0;
    double delta = 0, gap = 0;   // rounding of the count; distance of σ from u and the next value: a proof needs δ < gap [1/length²]
    bool delta_is_measured = false;   // by probes, if other processes hold the factor: `complete` depends on it
    int zero_eigenvalues = 0;         // eigenvalues ≤ 1e-9 of their μ₀ or, if these are too many, within rounding
    int components = 0;               // of the mesh, by its triangles; those without area may join two
    bool zeros_undecided = false;     // the two differ, but rounding hides which pairs have eigenvalue 0
    int expected_zeros = 0;           // the components, at most k
    double smallest_step_up = 0;      // between successive eigenvalues, over the largest: negative if they do not ascend, else 0

    static constexpr double orthonormality_limit = 1e-9, parseval_limit = 1e-9, step_down_limit = 1e-12;

    /// True if nothing was found below σ and nothing counted: k cuts the first cluster, for example if k is less than the components.
    bool says_nothing() const { return found_below == 0 && counted_below == 0; }
    bool residual_undecided() const { return residual > residual_limit && residual <= residual_rounding; }
    /// Returns `refuted` if a measure exceeds its limit or the count refutes; `proved` if every measure is within its limit and the count
    /// proves that none is missing; else `undecided`.
    Proof verdict() const;
    bool holds() const { return verdict() == Proof::proved; }
};

/// Measures and certifies any pairs, right or wrong. Costs one sparse factorisation, seldom more, and products with Φ; computes no
/// eigenvalue.
/// @param inertia_at  counts the eigenvalues below a shift
/// @throws MeshError if the sizes do not fit together, or the spectrum is empty
SpectrumCertificate certify_spectrum(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const Spectrum& spectrum,
                                     const InertiaAt& inertia_at = meshfolio::inertia_at);

/// Counts the eigenvalues of −Cφ = μMφ below σ, with the rounding of the count. [1/length²]
/// @throws SolverError if a pivot is lost in rounding: σ is too near an eigenvalue of a leading part
Inertia eigenvalues_below(const LaplaceBeltrami& laplacian, double sigma);

/// Compares a count of eigenvalues below σ with known values: `undecided` if a value lies within δ of σ, `proved` if as many values lie
/// below σ as are counted, else `refuted`.
Proof agreement(const Inertia& inertia, const Vector& values);

}   // namespace meshfolio
