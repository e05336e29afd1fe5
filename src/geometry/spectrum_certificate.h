/// @file
/// Proof that eigenpairs are right and that none is missing, measured on the operator and the mesh alone: nothing that the solver says
/// about its own work is used.
#pragma once

#include "geometry/laplace_spectrum.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct SpectrumCertificate {
    /// ‖−Cφ − μMφ‖/(max(μ, μ₀)‖Mφ‖) of the pair that is nearest to its limit, or farthest beyond it; infinite where a number is not
    /// finite. The limit is 1e-8, or what rounding of the operator's largest rows leaves, 100 ε max(A_ii/M_ii)/μ; never above 1e-3.
    /// μ₀ = median A_ii / ΣM is the operator's own unit: some 4 over the area for cotangents, whatever the unit of length. Where a pair
    /// lives on smaller components, their own units, weighted by its share on each.
    double residual = 0, residual_limit = 1e-8;
    double orthonormality_error = 0;   // largest entry of |ΦᵀMΦ − I|
    double parseval_gap = 0;   // |‖x‖²_M − Σ|ĉ|² − ‖x − Φĉ‖²_M| / ‖x‖²_M for the positions x about their centroid
    int pairs = 0;             // k
    /// Eigenvalues of the operator below a σ just above the last one found, by the inertia of −C − σM; −1 where no factorisation can be
    /// trusted. More than k where k cuts a cluster of equal ones.
    int counted_above = -1;
    /// σ just above the last eigenvalue or, where k cuts a cluster, just below that cluster; eigenvalues of the operator below it, by
    /// inertia; eigenvalues of the spectrum below it. [1/length²]
    double shift = 0;
    int counted_below = -1, found_below = 0;
    int zero_eigenvalues = 0;      // μ ≤ 1e-9 μ₀
    int expected_zeros = 0;        // components of the mesh with an area, by its triangles; at most k
    double smallest_step_up = 0;   // of the eigenvalues from one to the next, over the largest: negative where they are not ascending

    static constexpr double orthonormality_limit = 1e-9, parseval_limit = 1e-9, step_down_limit = 1e-12;

    /// None is missing below the last cluster, and up to its upper end there are as many as were found, or more of that cluster.
    bool complete() const { return counted_below == found_below && counted_above >= pairs; }
    bool holds() const {
        return residual <= residual_limit && orthonormality_error <= orthonormality_limit && parseval_gap <= parseval_limit && complete() &&
               zero_eigenvalues == expected_zeros && smallest_step_up >= -step_down_limit;
    }
};

/// Costs one or two sparse factorisations and products with Φ; no eigenvalue is computed.
/// @param spectrum  any pairs, also wrong ones
/// @throws MeshError if the sizes do not fit together, or nothing is in the spectrum
SpectrumCertificate certify_spectrum(const TriangleMesh& mesh, const LaplaceBeltrami& laplacian, const Spectrum& spectrum);

/// Eigenvalues of −Cφ = μMφ below σ: the negative pivots of an LDLᵀ of −C − σM (Sylvester's law of inertia).
/// @throws SolverError if σ is so near an eigenvalue that a pivot is lost in rounding
int eigenvalues_below(const LaplaceBeltrami& laplacian, double sigma);

}   // namespace meshfolio
