/// @file
/// One symbolic analysis for the factors of all positive definite matrices of one pattern, made for solving many times with few
/// right-hand sides: column by column below 100 000 rows, by supernodes above. Private to the layer.
#pragma once

#include <memory>

#include "geometry/linear/ldlt_panels.h"
#include "geometry/linear/sparse_factor.h"

namespace meshfolio {

enum class FactorForm { automatic, simplicial, supernodal };

class CholeskyAnalysis {
public:
    /// Of the pattern of A: compressed, symmetric, every diagonal entry stored.
    explicit CholeskyAnalysis(const SparseMatrix& A, FactorForm form = FactorForm::automatic,
                              FactorLibrary library = FactorLibrary::automatic);
    ~CholeskyAnalysis();

    /// Row order()[i] is eliminated as the i-th.
    std::vector<int> order() const;
    long long nonzeros() const;   // of a factor
    /// What making and keeping a factor takes at most. [bytes]
    double memory() const;

    /// @throws SolverError if A is not positive definite
    LdltPanels factor(const SparseMatrix& A) const;

private:
    std::unique_ptr<SparseFactor::Implementation> symbolic_;
};

}   // namespace meshfolio
