/// @file
/// One symbolic analysis for LDLᵀ of all A − σI of one pattern. Private to the layer.
#pragma once

#include "geometry/linear/front_tree.h"
#include "geometry/linear/inertia.h"
#include "geometry/linear/ldlt_panels.h"

namespace meshfolio {

class LdltAnalysis {
public:
    /// Ordered by approximate minimum degree (Amestoy, Davis & Duff 1996).
    /// @param A  whose pattern counts: compressed, symmetric, both triangles and every diagonal entry stored
    /// @throws SolverError if A is empty or not square
    explicit LdltAnalysis(const SparseMatrix& A);

    /// Row order()[i] is eliminated as the i-th: neighbours on the surface are mostly near each other in this order.
    const std::vector<int>& order() const { return tree_.order; }
    const std::vector<int>& place() const { return tree_.place; }   // its inverse
    long long nonzeros() const { return tree_.nonzeros; }           // of a factor, diagonal included
    long long entries() const { return tree_.entries(); }           // that it stores
    /// What making and keeping a factor takes at most. [bytes]
    double memory() const;

    /// LDLᵀ of A − σI. Several threads may factor at once; `parallel`: one factor is shared out among threads. The numbers are the same.
    /// @throws SolverError if an entry is not finite, or a pivot within a few roundings of zero: σ is an eigenvalue, or next to one
    LdltPanels factor(const SparseMatrix& A, double sigma, bool parallel = false) const;
    /// LDLᵀ with D > 0, which is Cholesky's factor L D^½. Its `growth` is not computed.
    /// @throws SolverError if an entry is not finite, or A is not positive definite
    LdltPanels factor_definite(const SparseMatrix& A, bool parallel = false) const;
    /// Eigenvalues of A below σ, by Sylvester's law of inertia.
    /// @throws SolverError as `factor`
    Inertia count_below(const SparseMatrix& A, double sigma, bool parallel = false) const;

private:
    FrontTree tree_;
};

}   // namespace meshfolio
