/// @file
/// The number of eigenvalues of Ax = μMx below σ, by Sylvester's law of inertia, with a bound of its rounding.
#pragma once

#include <functional>
#include <optional>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// A count of eigenvalues. LDLᵀ without pivoting has the inertia of a nearby matrix, A + E − σM with |xᵀEx| ≤ δ xᵀMx. Its eigenvalues lie
/// within δ of those of the pencil (Weyl), so that
///     #{μ < σ − δ} ≤ below ≤ #{μ < σ + δ}.
/// The count proves something only if δ is smaller than the distance of σ from the eigenvalues in question.
struct Inertia {
    double sigma = 0;
    int below = 0;           // negative pivots of A − σM
    double delta = 0;        // δ, including that of forming A − σM; infinite if it cannot be computed
    bool measured = false;   // true: δ is measured, not proved (geometry/distributed)
};

/// The verdict of a count on a claim. undecided: rounding is too large for a proof.
enum class Proof { proved, refuted, undecided };

/// Counts the eigenvalues μ of Ax = μMx below σ, with δ proved.
/// @param A  symmetric; its lower triangle is read
/// @param M  the diagonal of M, > 0
/// @throws SolverError if a pivot is lost in rounding: σ is an eigenvalue of a leading part, or next to one
Inertia inertia_at(const SparseMatrix& A, const Vector& M, double sigma);
using InertiaAt = std::function<Inertia(const SparseMatrix& A, const Vector& M, double sigma)>;

/// Counts the eigenvalues below some σ between `low` and `high`: the first tried with δ smaller than its distance from both, else the one
/// whose distance from the nearer end is most in units of δ; at most four are counted. Without 2 × 2 pivots a pivot may vanish at a σ far
/// from any eigenvalue, but not at others near it.
/// @return nothing if every σ tried loses a pivot
std::optional<Inertia> inertia_between(const SparseMatrix& A, const Vector& M, double low, double high,
                                       const InertiaAt& count = inertia_at);

}   // namespace meshfolio
