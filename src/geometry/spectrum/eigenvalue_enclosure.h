/// @file
/// The largest eigenvalue μ of M⁻¹S between two proved bounds, without its eigenvector.
///   above: LDLᵀ of σM − S runs to its end with D > 0 ⇒ μ ≤ σ + ρ   (Rump 2006, for Cholesky's factor L D^½)
///   below: μ ≥ yᵀSy / yᵀMy for every y
/// If the factorisation just above the quotient breaks down, one farther above is the preconditioner of a few steps of Lanczos with
/// (σM − S)⁻¹M, which raise the quotient; σ follows it. Neighbours of μ do no harm: the value is right long before the vector.
///
/// The bounds hold for the numbers stored in S and M. They include bounds of the rounding of the factorisation and of the quotient: the
/// computed factor is exactly that of a matrix no farther from σM − S than ρ times M (sparse_factor.h). Not covered: the rounding of S and
/// M in their assembly, underflow, and defects of the processor. Private to the layer.
#pragma once

#include <optional>

#include "geometry/linear/sparse_factor.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

struct Enclosure {
    double low = 0, high = 0;        // proved: low ≤ μ ≤ high
    double quotient = 0;             // yᵀSy/yᵀMy: `low` without its rounding
    Vector y;                        // where eigenvalues crowd at the top, a mixture of their vectors
    double rounding = 0;             // ρ of the factorisation that proves `high`; 0 if none does
    int factorisations = 0;          // 1 when the first one held
    int failed = 0;                  // the number of these that broke down: μ lay above their σ
    long long factor_nonzeros = 0;   // of the largest factor
};

struct EnclosureOptions {
    double high = 0;          // a known bound ≥ μ
    double least_scale = 0;   // widths are relative to the quotient, or to this if it is larger
    double width = 1e-8;      // wanted high − low, relative
    double missing = 0;       // estimate of how far the quotient of `start` lies below μ, relative
};

/// Encloses the largest eigenvalue μ of M⁻¹S. The bounds stay farther apart than `width` if rounding forbids more.
/// @param start  a guess of the vector; it may be wrong, 0 or not finite
Enclosure enclose_largest(const SparseMatrix& S, const Vector& M, const Vector& start, const EnclosureOptions& options);

/// Returns Cholesky's factor of σM − S, or nothing if it breaks down.
std::optional<SparseFactor> factor_at(const SparseMatrix& S, const Vector& M, double sigma);
/// Returns ρ, the rounding of factor_at(S, M, σ), from the factor: μ ≤ σ + ρ. It includes at most ε|σ| for forming σM. [as σ]
double rounding_of(const SparseFactor& factor, const Vector& M, double sigma);

/// A Rayleigh quotient between bounds of its rounding.
struct Quotient {
    double value = 0, low = 0, high = 0;
};
/// Returns yᵀSy/yᵀMy with bounds of its rounding. n products with sums of k are off by at most ε(n + k + 4)/2 of the sum of magnitudes.
Quotient rayleigh_quotient(const SparseMatrix& S, const Vector& M, const Vector& y);

}   // namespace meshfolio
