#include "geometry/linear/ldlt_analysis.h"

#include <cmath>
#include <limits>

#include "geometry/linear/factor_implementation.h"
#include "geometry/linear/ldlt_rounding.h"

namespace meshfolio {

namespace {

using Implementation = SparseFactor::Implementation;

SparseMatrix shifted(SparseMatrix A, double sigma) {
    for (int j = 0; j < A.cols(); ++j) A.coeffRef(j, j) -= sigma;
    return A;
}

/// Of A − σI from the matrix factored, in the 2-norm.
double distance_of(const Implementation& L, double sigma) {
    return backward_error(L, Vector::Ones(L.rows), 1) + std::numeric_limits<double>::epsilon() * std::abs(sigma);
}

}   // namespace

LdltAnalysis::LdltAnalysis(const SparseMatrix& A, FactorLibrary library)
    : A_(A), symbolic_(analysed(A, FactorKind::ldlt, library)), order_(symbolic_->order()) {}
LdltAnalysis::~LdltAnalysis() = default;

long long LdltAnalysis::nonzeros() const { return symbolic_->nonzeros(); }

std::unique_ptr<Implementation> LdltAnalysis::factored(double sigma) const {
    auto factor = symbolic_->analysed_copy(A_);
    factorize_checked(*factor, shifted(A_, sigma));
    return factor;
}

LdltPanels LdltAnalysis::factor(double sigma) const {
    const auto L = factored(sigma);
    LdltPanels panels = panels_of(*L);
    const Vector pivots = L->pivots();
    panels.delta = distance_of(*L, sigma);
    panels.growth = (pivots.array() / (A_.diagonal().array() - sigma)).abs().maxCoeff();
    return panels;
}

Inertia LdltAnalysis::count_below(double sigma) const {
    const auto L = factored(sigma);
    return {sigma, L->negative, distance_of(*L, sigma)};
}

}   // namespace meshfolio
