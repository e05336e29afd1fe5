/// @file
/// One symbolic analysis for LDLᵀ of all A − σI. Private to the layer.
#pragma once

#include <memory>

#include "geometry/linear/inertia.h"
#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/sparse_factor.h"

namespace meshfolio {

class LdltAnalysis {
public:
    /// Keeps a reference to A: compressed, symmetric, every diagonal entry stored.
    explicit LdltAnalysis(const SparseMatrix& A, FactorLibrary library = FactorLibrary::automatic);
    ~LdltAnalysis();

    /// Row order()[i] is eliminated as the i-th: neighbours on the surface are mostly near each other in this order.
    const std::vector<int>& order() const { return order_; }
    long long nonzeros() const;   // of a factor

    /// LDLᵀ of A − σI. Several threads may factor at once.
    /// @throws SolverError if a pivot is within a few roundings of zero: σ is an eigenvalue, or next to one
    LdltPanels factor(double sigma) const;
    /// Eigenvalues of A below σ, by Sylvester's law of inertia.
    /// @throws SolverError as `factor`
    Inertia count_below(double sigma) const;

private:
    std::unique_ptr<SparseFactor::Implementation> factored(double sigma) const;

    const SparseMatrix& A_;
    std::unique_ptr<SparseFactor::Implementation> symbolic_;
    std::vector<int> order_;
};

}   // namespace meshfolio
