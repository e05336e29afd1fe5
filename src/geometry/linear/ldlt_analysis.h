/// @file
/// One symbolic analysis for LDLᵀ of all A − σI. Private to the layer.
#pragma once

#include "geometry/linear/front_tree.h"
#include "geometry/linear/inertia.h"
#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/sparse_factor.h"

namespace meshfolio {

class LdltAnalysis {
public:
    /// Keeps a reference to A: compressed, symmetric, every diagonal entry stored.
    /// @param library  whose ordering
    explicit LdltAnalysis(const SparseMatrix& A, FactorLibrary library = FactorLibrary::automatic);

    /// Row order()[i] is eliminated as the i-th: neighbours on the surface are mostly near each other in this order.
    const std::vector<int>& order() const { return tree_.order; }
    const std::vector<int>& place() const { return tree_.place; }   // its inverse
    long long nonzeros() const { return tree_.entries(); }          // of a factor

    /// LDLᵀ of A − σI. Several threads may factor at once; `parallel`: one factor is shared out among threads. The numbers are the same.
    /// @throws SolverError if a pivot is within a few roundings of zero: σ is an eigenvalue, or next to one
    LdltPanels factor(double sigma, bool parallel = false) const;
    /// Eigenvalues of A below σ, by Sylvester's law of inertia.
    /// @throws SolverError as `factor`
    Inertia count_below(double sigma, bool parallel = false) const;

private:
    const SparseMatrix& A_;
    FrontTree tree_;
};

}   // namespace meshfolio
