/// @file
/// The largest eigenvalue μ of M⁻¹S between two proved bounds, without knowing its eigenvector.
///   above: LDLᵀ of σM − S runs to its end with D > 0 ⇒ μ ≤ σ + ρ   (Rump 2006, for Cholesky's factor L D^½)
///   below: μ ≥ yᵀSy / yᵀMy for every y
/// Where the factorisation just above the quotient breaks down, one farther above serves as the preconditioner of a few steps of Lanczos
/// with (σM − S)⁻¹M, which raise the quotient; σ follows it down. Neighbours of μ do no harm: the value is right long before the vector.
///
/// What floating point can prove: the bounds hold for the numbers stored in S and M. The rounding of the factorisation and of the
/// quotient is bounded and is part of the bounds: the factor computed is exactly that of a matrix no farther from σM − S than ρ times M
/// (ldlt_panels.h). Not covered: the rounding of S and M themselves when they were assembled, underflow, and defects of the processor.
/// Private to the layer.
#pragma once

#include <optional>

#include "geometry/linear/sparse_factor.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Enclosure {
    double low = 0, high = 0;        // proved: low ≤ μ ≤ high
    double quotient = 0;             // what low is without its rounding
    Vector y;                        // whose quotient it is; where eigenvalues crowd at the top, a mixture of their vectors
    double rounding = 0;             // ρ of the factorisation that proves `high`; 0 where none does
    int factorisations = 0;          // 1 when the first one held
    int failed = 0;                  // of these, how many broke down: μ lay above their σ
    long long factor_nonzeros = 0;   // of the largest factor
};

struct EnclosureOptions {
    double high = 0;          // a bound known beforehand, ≥ μ
    double least_scale = 0;   // what widths are relative to, where the quotient is smaller
    double width = 1e-8;      // wanted: high − low, relative
    double missing = 0;       // how far the quotient of `start` is thought to lie below μ, relative
};

/// Both bounds. They stay farther apart than `width` where rounding forbids more.
/// @param start  nothing of it is trusted; one that is not finite, or 0, is left aside
Enclosure enclose_largest(const SparseMatrix& S, const Vector& M, const Vector& start, const EnclosureOptions& options);

/// Cholesky of σM − S, or nothing where it breaks down.
std::optional<SparseFactor> factor_at(const SparseMatrix& S, const Vector& M, double sigma);
/// ρ of that factorisation: its own, and that of σM, ε|σ| at most. [as σ]
double rounding_of(const SparseFactor& factor, const Vector& M, double sigma);

/// yᵀSy/yᵀMy, with bounds that include its rounding: n products with sums of k are off by at most ε(n + k + 4)/2 of the magnitudes' sum.
struct Quotient {
    double value = 0, low = 0, high = 0;
};
Quotient rayleigh_quotient(const SparseMatrix& S, const Vector& M, const Vector& y);

}   // namespace meshfolio
