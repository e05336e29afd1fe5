/// @file
/// How many eigenvalues of Ax = μMx lie below a number, by Sylvester's law of inertia, and how far rounding may have moved that number.
#pragma once

#include <functional>
#include <optional>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// LDLᵀ without pivoting has the inertia of a nearby matrix, A + E − σM with |xᵀEx| ≤ δ xᵀMx. Its eigenvalues lie within δ of those of
/// the pencil (Weyl), so that
///     #{μ < σ − δ} ≤ below ≤ #{μ < σ + δ}.
/// The count proves something only where δ is smaller than the distance of σ from what it is to be told apart from.
struct Inertia {
    double sigma = 0;
    int below = 0;           // negative pivots of A − σM
    double delta = 0;        // δ, that of forming A − σM included; infinite where it cannot be computed
    bool measured = false;   // δ is not proved but measured (geometry/distributed)
};

/// What a count can say of a claim. undecided: rounding may do more than what is to be told apart; it cannot be proved here.
enum class Proof { proved, refuted, undecided };

/// @param A  its lower triangle is read
/// @param M  > 0
/// @throws SolverError if a pivot is lost in rounding: σ is an eigenvalue of a leading part, or next to one
Inertia inertia_at(const SparseMatrix& A, const Vector& M, double sigma);
using InertiaAt = std::function<Inertia(const SparseMatrix& A, const Vector& M, double sigma)>;

/// At some σ between two numbers, the first tried whose δ is smaller than its distance from both, else the best of those tried. Without
/// 2 × 2 pivots a pivot may vanish at a σ far from any eigenvalue, but not a little beside it.
/// @return nothing if every σ tried loses a pivot
std::optional<Inertia> inertia_between(const SparseMatrix& A, const Vector& M, double low, double high,
                                       const InertiaAt& count = inertia_at);

}   // namespace meshfolio
